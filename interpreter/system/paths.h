#pragma once

#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

/// What paths are on this system, where std::filesystem does not know it: that of MinGW takes `\\server\share` for
/// `\server\share`, a folder of this computer, and its functions do not reach names of more than 260 characters. All
/// other code asks these functions.
namespace isocnc::system {

/// The path with `/` as its only separator: `C:/parts/a.iso`, `//server/share/a.iso`.
std::string generic_name(const std::filesystem::path& path);

/// As path::lexically_normal().
std::filesystem::path normal(const std::filesystem::path& path);

/// As path::has_root_name(): `C:`, `\\server`. Never elsewhere than on Windows.
bool has_root_name(const std::filesystem::path& path);

/// As path::is_absolute().
bool is_absolute(const std::filesystem::path& path);

// As the functions of std::filesystem.
std::filesystem::path absolute(const std::filesystem::path& path, std::error_code& error);
std::filesystem::path canonical(const std::filesystem::path& path, std::error_code& error);
std::filesystem::path weakly_canonical(const std::filesystem::path& path, std::error_code& error);

/// The absolute path; as it is written if the system cannot say.
std::filesystem::path absolute(const std::filesystem::path& path);

/// A name in a folder.
struct FolderEntry {
  std::filesystem::path name;
  bool is_symlink = false;
  bool is_folder = false;  ///< Of what a symlink means, too.
  bool is_file = false;    ///< A regular one, likewise.
};

/// The names in a folder, in any order.
std::vector<FolderEntry> entries_of(const std::filesystem::path& folder, std::error_code& error);

}  // namespace isocnc::system
