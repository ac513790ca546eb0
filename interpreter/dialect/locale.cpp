#include "interpreter/dialect/locale.h"

#include <cstdlib>

namespace isocnc::dialect {

Language language_of_environment() {
  for (const char* variable : {"LC_ALL", "LC_MESSAGES", "LANG"}) {
    const char* const value = std::getenv(variable);  // NOLINT(concurrency-mt-unsafe): nobody sets it.
    if (!value || *value == '\0') continue;
    const std::string_view locale(value);
    const bool italian = locale == "it" || locale.starts_with("it_") || locale.starts_with("it.");
    return italian ? Language::Italian : Language::English;
  }
  return Language::English;
}

}  // namespace isocnc::dialect
