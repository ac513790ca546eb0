#include "interpreter/dialect/locale.h"

#include <algorithm>
#include <iterator>

#include "interpreter/dialect/any_case.h"

namespace isocnc::dialect {

std::optional<Language> language_named(std::string_view name) {
  const auto* const found = std::find(std::begin(kLanguageNames), std::end(kLanguageNames), name);
  if (found == std::end(kLanguageNames)) return std::nullopt;
  return static_cast<Language>(found - std::begin(kLanguageNames));
}

std::string_view name_of(Language language) { return kLanguageNames[static_cast<std::size_t>(language)]; }

Language language_of_locale(std::string_view locale) {
  const std::string_view name = locale.substr(0, locale.find_first_of("_-.@"));
  return equal_words(name, name_of(Language::Italian)) ? Language::Italian : Language::English;
}

}  // namespace isocnc::dialect
