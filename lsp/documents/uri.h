#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace isocnc::lsp::documents {

/// The file that a URI names: nothing where it names none, as `untitled:` does.
std::optional<std::filesystem::path> path_of(std::string_view uri);

/// Whether a URI names a configuration file: that is no program, though the editor may hold it open as well.
bool names_configuration(std::string_view uri);

/// `file:///part%201.iso`, of an absolute path.
std::string uri_of(const std::filesystem::path& path);

}  // namespace isocnc::lsp::documents
