#pragma once

#include <filesystem>

namespace isocnc::system {

/// Where a file is, or would be made that is not there yet: symlinks are followed, to nowhere, too.
std::filesystem::path place_of(std::filesystem::path path);

/// Whether the name leads to a descriptor that is open, as /dev/stdout does, whatever stands behind that.
bool names_descriptor(std::filesystem::path path);

/// Whether two names lead to one file, by links or other ways around, even where it is not there yet. Devices and pipes
/// are none: they take from many.
bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace isocnc::system
