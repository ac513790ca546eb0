#pragma once

#include <filesystem>

namespace isocnc::system {

/// The path of a file, existing or not, with symlinks followed, even those to a missing target.
std::filesystem::path place_of(std::filesystem::path path);

/// Whether the name leads to an open descriptor of any kind, as /dev/stdout does.
bool names_descriptor(std::filesystem::path path);

/// Whether two names lead to one file, by links or different spellings, even if it does not exist yet. False for
/// devices and pipes, which accept several writers.
bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace isocnc::system
