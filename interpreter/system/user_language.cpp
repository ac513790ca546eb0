#include "interpreter/system/user_language.h"

#include <cstdlib>

#include "interpreter/dialect/locale.h"
#include "interpreter/system/process.h"

namespace isocnc::system {

dialect::Language user_language() {
  for (const char* variable : {"LC_ALL", "LC_MESSAGES", "LANG"}) {
    const char* const value = std::getenv(variable);  // NOLINT(concurrency-mt-unsafe): nobody sets it.
    if (value && *value != '\0') return dialect::language_of_locale(value);
  }
  return dialect::language_of_locale(user_locale());
}

}  // namespace isocnc::system
