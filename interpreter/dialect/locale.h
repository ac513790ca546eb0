#pragma once

#include <optional>
#include <string_view>

#include "interpreter/dialect/diagnostic.h"

/// Languages by their names.
namespace isocnc::dialect {

/// The names of the languages in commands, files and messages, in the order of Language.
inline constexpr std::string_view kLanguageNames[] = {"en", "it"};
std::optional<Language> language_named(std::string_view name);
std::string_view name_of(Language language);

/// The language of a locale such as `it_IT.UTF-8`, `it-IT` or `it`; English unless it is Italian.
Language language_of_locale(std::string_view locale);

}  // namespace isocnc::dialect
