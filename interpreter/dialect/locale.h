#pragma once

#include "interpreter/dialect/diagnostic.h"

namespace isocnc::dialect {

/// The user's language by LC_ALL, LC_MESSAGES or LANG, in this order; English unless one says Italian.
Language language_of_environment();

}  // namespace isocnc::dialect
