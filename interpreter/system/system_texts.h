#pragma once

#include <string>
#include <system_error>

#include "interpreter/dialect/diagnostic.h"

namespace isocnc::system {

/// `Address already in use`, for an errno.
std::string reason_of(int error, dialect::Language language);

/// `cannot read: Permission denied`, for an errno.
std::string cannot_read(int error, dialect::Language language);
std::string cannot_read(const std::error_code& error, dialect::Language language);

/// `cannot write: No space left on device`, for an errno.
std::string cannot_write(int error, dialect::Language language);

}  // namespace isocnc::system
