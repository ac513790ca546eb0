#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace isocnc::protocol {

/// The file that a URI names; nothing if it names none, such as an `untitled:` URI.
std::optional<std::filesystem::path> path_of(std::string_view uri);

/// Whether a URI names a configuration file, which is not a program although the editor may have it open.
bool names_configuration(std::string_view uri);
/// Whether a URI names the setup of a program, such as `door.setup.json`.
bool names_setup(std::string_view uri);

/// The URI of an absolute path, such as `file:///part%201.iso`.
std::string uri_of(const std::filesystem::path& path);

}  // namespace isocnc::protocol
