#pragma once

#include <filesystem>
#include <string_view>

namespace isocnc::running {

/// Gives a file this content at once: whoever reads it finds the old one or the new one, whole, and the old one when
/// something fails. The text is written beside the file, to the disk, and the file is then replaced. Returns 0 or the
/// errno.
int write_atomically(const std::filesystem::path& path, std::string_view text);

}  // namespace isocnc::running
