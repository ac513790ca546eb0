#pragma once

#include "interpreter/dialect/diagnostic.h"

namespace isocnc::system {

/// The user's language: the first of LC_ALL, LC_MESSAGES and LANG that is set decides, then the system's own choice;
/// English unless it is Italian.
dialect::Language user_language();

}  // namespace isocnc::system
