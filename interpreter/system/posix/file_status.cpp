#include "interpreter/system/file_status.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>

namespace isocnc::system {

namespace fs = std::filesystem;

/// Permissions: what chmod can set.
static constexpr mode_t kModeBits = 07777;

static FileStatus status_from(const struct stat& status) {
  using Kind = FileStatus::Kind;
  constexpr std::int64_t kNanoseconds = 1'000'000'000;
  return {.kind = S_ISREG(status.st_mode)   ? Kind::Regular
                  : S_ISDIR(status.st_mode) ? Kind::Folder
                                            : Kind::Other,
          .size = static_cast<std::uint64_t>(status.st_size),
          .identity = {status.st_dev, status.st_ino, 0},
          .names = status.st_nlink,
          .changed = status.st_mtim.tv_sec * kNanoseconds + status.st_mtim.tv_nsec,
          .mode = status.st_mode & kModeBits,
          .owner = status.st_uid,
          .group = status.st_gid};
}

std::optional<FileStatus> status_of(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return std::nullopt;
  return status_from(status);
}

std::optional<FileStatus> status_of(int descriptor) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) return std::nullopt;
  return status_from(status);
}

bool may_write(const fs::path& path) { return ::access(path.c_str(), W_OK) == 0; }

/// Sets the mode last, since a change of owner clears bits of it.
bool take_over_attributes(int descriptor, const fs::path&, const FileStatus& of_replaced) {
  const std::optional<FileStatus> now = status_of(descriptor);
  if (!now) return false;
  const bool owner_differs = now->owner != of_replaced.owner || now->group != of_replaced.group;
  // A user who may not change the owner may still keep the group.
  if (owner_differs && ::fchown(descriptor, of_replaced.owner, of_replaced.group) != 0 &&
      ::fchown(descriptor, static_cast<uid_t>(-1), of_replaced.group) != 0 && errno != EPERM)
    return false;
  return ::fchmod(descriptor, of_replaced.mode) == 0;
}

/// Writes a folder's entries to the disk. Errors are ignored: the files themselves are complete.
static void sync_folder(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

int rename_over(const fs::path& from, const fs::path& to) {
  if (std::rename(from.c_str(), to.c_str()) != 0) return errno;
  sync_folder(to.parent_path());
  return 0;
}

void remove_file(const char* name) { ::unlink(name); }

}  // namespace isocnc::system
