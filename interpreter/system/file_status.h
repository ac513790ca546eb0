#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>

namespace isocnc::system {

/// What the system says of a file, symlinks followed.
struct FileStatus {
  enum class Kind : std::uint8_t { Regular, Folder, Other };

  Kind kind = Kind::Other;
  std::uint64_t size = 0;                   ///< Bytes.
  std::array<std::uint64_t, 3> identity{};  ///< Equal for the same file only, whatever its names.
  std::uint64_t names = 1;                  ///< Its names, hard links included.
  std::int64_t changed = 0;                 ///< When its content last changed: for comparison only.
  std::uint32_t mode = 0;                   ///< POSIX: permissions. 0 on Windows, like owner and group.
  std::uint32_t owner = 0;
  std::uint32_t group = 0;

  /// Whether it is still the same file, with the same content as far as the system tells.
  bool is_unchanged_since(const FileStatus& before) const {
    return identity == before.identity && size == before.size && changed == before.changed;
  }
};

/// Nothing if the file does not exist or cannot be reached, with the reason in errno.
std::optional<FileStatus> status_of(const std::filesystem::path& path);
std::optional<FileStatus> status_of(int descriptor);

/// Whether the user may write a file that exists; else errno says why not.
bool may_write(const std::filesystem::path& path);

/// Gives a new file the permissions of the one that it will replace and, if permitted, its owner. Sets errno on
/// failure.
bool take_over_attributes(int descriptor, const std::filesystem::path& replaced, const FileStatus& of_replaced);

/// Renames a file over another, which need not exist: readers find the one or the other. Returns 0 or the errno.
int rename_over(const std::filesystem::path& from, const std::filesystem::path& to);
/// Removes a file by its name as the system spells it; can be called in a signal handler.
void remove_file(const std::filesystem::path::value_type* name);

}  // namespace isocnc::system
