#pragma once

namespace isocnc::system {

/// The errno for an error of Windows; EIO for one that has no better.
int errno_of(unsigned long error);

/// Sets errno from the last error of Windows.
void keep_last_error();

}  // namespace isocnc::system
