#include "interpreter/system/paths.h"

#include <windows.h>

#include <algorithm>
#include <string_view>

#include "interpreter/system/windows/native_path.h"

namespace isocnc::system {

namespace fs = std::filesystem;

static bool is_slash(wchar_t letter) { return letter == L'\\' || letter == L'/'; }

/// The length of `\\server\share`, or of `\\?\C:`; 0 if the path does not begin so.
static std::size_t server_length(std::wstring_view path) {
  if (path.size() < 3 || !is_slash(path[0]) || !is_slash(path[1]) || is_slash(path[2])) return 0;
  const std::size_t server = std::min(path.find_first_of(L"\\/", 2), path.size());
  const std::size_t share = std::min(path.find_first_not_of(L"\\/", server), path.size());
  return std::min(path.find_first_of(L"\\/", share), path.size());
}

/// A path divided into `\\server\share`, or nothing, and the rest.
struct DividedPath {
  std::wstring server;
  fs::path rest;
};
static DividedPath divided(const fs::path& path) {
  const std::wstring& whole = path.native();
  const std::size_t length = server_length(whole);
  std::wstring server = whole.substr(0, length);
  std::replace(server.begin(), server.end(), L'/', L'\\');
  return {std::move(server), whole.substr(length)};
}

static fs::path joined(const std::wstring& server, const fs::path& rest) { return server + rest.native(); }

std::string generic_name(const fs::path& path) {
  const DividedPath parts = divided(path);
  std::string server = fs::path(parts.server).string();
  std::replace(server.begin(), server.end(), '\\', '/');
  return server + parts.rest.generic_string();
}

fs::path normal(const fs::path& path) {
  const DividedPath parts = divided(path);
  return parts.server.empty() ? path.lexically_normal() : joined(parts.server, parts.rest.lexically_normal());
}

bool has_root_name(const fs::path& path) { return path.has_root_name() || server_length(path.native()) > 0; }

bool is_absolute(const fs::path& path) { return path.is_absolute() || server_length(path.native()) > 0; }

fs::path absolute(const fs::path& path, std::error_code& error) {
  error.clear();
  if (server_length(path.native()) > 0) return path;
  // A folder of a server as the current one, which the library would take for one of this computer.
  std::error_code ignored;
  const fs::path here = fs::current_path(ignored);
  const bool is_relative = !path.has_root_name() && !path.has_root_directory();
  if (is_relative && server_length(here.native()) > 0) return here / path;
  return fs::absolute(path, error);
}

fs::path absolute(const fs::path& path) {
  std::error_code error;
  fs::path whole = system::absolute(path, error);
  return error ? path : whole;
}

/// Whether the library's own functions know the path.
static bool is_known_to_library(const fs::path& whole) {
  return server_length(whole.native()) == 0 && native(whole) == whole.native();
}

/// Where a symbolic link leads in the end; the path itself if it is none. The library takes links for files.
static fs::path behind_link(const fs::path& path) {
  WIN32_FIND_DATAW found{};
  HANDLE const search = ::FindFirstFileW(native(path).c_str(), &found);
  if (search == INVALID_HANDLE_VALUE) return path;
  ::FindClose(search);
  if ((found.dwFileAttributes & FILE_ATTRIBUTE_REPARSE_POINT) == 0 || found.dwReserved0 != IO_REPARSE_TAG_SYMLINK)
    return path;
  HANDLE const file = ::CreateFileW(native(path).c_str(), 0, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE,
                                    nullptr, OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS, nullptr);
  if (file == INVALID_HANDLE_VALUE) return path;
  std::wstring name(32768, L'\0');  // The longest that there is.
  name.resize(::GetFinalPathNameByHandleW(file, name.data(), static_cast<DWORD>(name.size()), FILE_NAME_NORMALIZED));
  ::CloseHandle(file);
  constexpr std::wstring_view kServer = LR"(\\?\UNC\)";
  constexpr std::wstring_view kDrive = LR"(\\?\)";
  if (name.starts_with(kServer)) return LR"(\\)" + name.substr(kServer.size());
  return name.starts_with(kDrive) ? fs::path(name.substr(kDrive.size())) : path;
}

fs::path canonical(const fs::path& path, std::error_code& error) {
  const fs::path given = system::absolute(path, error);
  if (error) return {};
  const fs::path whole = behind_link(given);
  if (is_known_to_library(whole)) return fs::canonical(whole, error);
  if (::GetFileAttributesW(native(whole).c_str()) == INVALID_FILE_ATTRIBUTES) {
    error.assign(static_cast<int>(::GetLastError()), std::system_category());
    return {};
  }
  return normal(whole);
}

fs::path weakly_canonical(const fs::path& path, std::error_code& error) {
  const fs::path whole = system::absolute(path, error);
  if (error) return {};
  return is_known_to_library(whole) ? fs::weakly_canonical(whole, error) : normal(whole);
}

std::vector<FolderEntry> entries_of(const fs::path& folder, std::error_code& error) {
  error.clear();
  std::vector<FolderEntry> entries;
  WIN32_FIND_DATAW found{};
  HANDLE const search = ::FindFirstFileW(native(system::absolute(folder) / L"*").c_str(), &found);
  if (search == INVALID_HANDLE_VALUE) {
    error.assign(static_cast<int>(::GetLastError()), std::system_category());
    return entries;
  }
  do {
    const std::wstring_view name = found.cFileName;
    if (name == L"." || name == L"..") continue;
    const bool is_folder = (found.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY) != 0;
    // A mount point is entered like a folder, as everywhere.
    const bool is_symlink =
        (found.dwFileAttributes & FILE_ATTRIBUTE_REPARSE_POINT) != 0 && found.dwReserved0 == IO_REPARSE_TAG_SYMLINK;
    entries.push_back({.name = fs::path(std::wstring(name)),
                       .is_symlink = is_symlink,
                       .is_folder = is_folder,
                       .is_file = !is_folder && (found.dwFileAttributes & FILE_ATTRIBUTE_DEVICE) == 0});
  } while (::FindNextFileW(search, &found) != 0);
  if (::GetLastError() != ERROR_NO_MORE_FILES) error.assign(static_cast<int>(::GetLastError()), std::system_category());
  ::FindClose(search);
  return entries;
}

}  // namespace isocnc::system
