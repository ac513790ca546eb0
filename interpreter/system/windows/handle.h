#pragma once

#include <filesystem>

namespace isocnc::system {

/// Opens a file or folder, which others may read, write, rename and remove meanwhile, such as a CAM system that posts
/// the program again. `access` and `how` are those of CreateFileW(). A HANDLE, INVALID_HANDLE_VALUE on failure, with
/// the reason in errno.
void* open_shared(const std::filesystem::path& path, unsigned long access, unsigned long how);

void* handle_of(int descriptor);

}  // namespace isocnc::system
