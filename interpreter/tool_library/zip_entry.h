#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace isocnc::tool_library {

/// A file in a ZIP archive, unpacked; none if there is no such file, or the archive is damaged, encrypted or packed by
/// a method other than deflate, or the file has more than `limit` bytes.
std::optional<std::string> zip_entry(std::string_view archive, std::string_view name, std::size_t limit);

}  // namespace isocnc::tool_library
