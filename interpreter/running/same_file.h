#pragma once

#include <filesystem>

namespace isocnc::running {

/// Whether two names lead to one file, by links or other ways around, even where it is not there yet. Devices and pipes
/// are none: they take from many.
bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace isocnc::running
