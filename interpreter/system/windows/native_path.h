#pragma once

#include <filesystem>
#include <string>

namespace isocnc::system {

/// A path as the system takes it whatever its length: from 248 characters on with `\\?\` in front.
std::wstring native(const std::filesystem::path& path);

}  // namespace isocnc::system
