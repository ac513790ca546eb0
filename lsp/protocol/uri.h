#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace isocnc::protocol {

/// The file that a URI names; nothing if it names none, such as an `untitled:` URI.
std::optional<std::filesystem::path> path_of(std::string_view uri);

/// Whether a URI names a configuration or the setup of a program, such as `door.setup.json`: files that are no programs
/// although the editor may have them open.
bool names_configuration(std::string_view uri);
/// Whether a URI names an STL file, which a setup may name.
bool names_shape(std::string_view uri);

/// The URI of an absolute path, such as `file:///part%201.iso`.
std::string uri_of(const std::filesystem::path& path);

}  // namespace isocnc::protocol
