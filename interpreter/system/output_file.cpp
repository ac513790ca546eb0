#include "interpreter/system/output_file.h"

#include <fcntl.h>
#include <sys/random.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>

#include <fmt/format.h>

#include "interpreter/system/same_file.h"
#include "interpreter/system/system_texts.h"

namespace isocnc::system {

namespace fs = std::filesystem;

/// Permissions: what chmod can set.
static constexpr mode_t kModeBits = 07777;

static int open_to_write(const std::string& path, int flags, mode_t mode) {
  int descriptor = -1;
  do {
    descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | flags, mode);
  } while (descriptor < 0 && errno == EINTR);
  return descriptor;
}

OutputFile::OutputFile(const fs::path& path) : owns_descriptor_(true) {
  struct stat status {};
  const bool is_there = ::stat(path.c_str(), &status) == 0;
  if (!is_there && errno != ENOENT) {
    error_ = errno;
  } else if (is_there && (!S_ISREG(status.st_mode) || names_descriptor(path))) {
    open_in_place(path);
  } else {
    if (is_there) status_ = status;
    target_ = place_of(path);
    open_beside();
  }
}

OutputFile::~OutputFile() {
  if (owns_descriptor_ && descriptor_ >= 0) ::close(descriptor_);
}

/// Opens the file for appending, so that text of other writers stays.
void OutputFile::open_in_place(const fs::path& path) {
  descriptor_ = open_to_write(path, O_APPEND, 0666);
  if (descriptor_ < 0) error_ = errno;
}

/// Opens a file with an unpredictable name that has no extension of programs, in case it is left behind.
void OutputFile::open_beside() {
  constexpr int kAttempts = 100;
  if (status_ && ::access(target_.c_str(), W_OK) != 0) {  // A rename does not check write access.
    error_ = errno;
    return;
  }
  const std::string start = target_.parent_path() / ("." + target_.filename().string().substr(0, 200) + ".isocnc-");
  for (int i = 0; i < kAttempts && descriptor_ < 0; ++i) {
    std::uint32_t number = 0;
    if (::getentropy(&number, sizeof number) != 0) break;
    std::string name = fmt::format("{}{:08x}", start, number);
    // Other users must not read a replacement of a file that they may not read.
    descriptor_ = open_to_write(name, O_EXCL, status_ ? 0600 : 0666);
    if (descriptor_ >= 0) {
      temporary_.emplace(std::move(name));
    } else if (errno != EEXIST) {
      break;
    }
  }
  if (descriptor_ < 0) error_ = errno;
}

void OutputFile::write(std::string_view text) {
  if (error_ != 0) return;
  gathered_ += text;
  if (gathered_.size() >= kLarge) flush();
}

int OutputFile::flush() {
  std::string_view rest = gathered_;
  while (!rest.empty() && error_ == 0) {
    const ssize_t count = ::write(descriptor_, rest.data(), rest.size());
    if (count >= 0) {
      rest.remove_prefix(static_cast<std::size_t>(count));
    } else if (errno != EINTR) {
      error_ = errno;
    }
  }
  gathered_.clear();
  return error_;
}

/// Sets the mode last, since a change of owner clears bits of it.
bool OutputFile::take_over_attributes() const {
  struct stat now {};
  if (::fstat(descriptor_, &now) != 0) return false;
  const bool owner_differs = now.st_uid != status_->st_uid || now.st_gid != status_->st_gid;
  // A user who may not change the owner may still keep the group.
  if (owner_differs && ::fchown(descriptor_, status_->st_uid, status_->st_gid) != 0 &&
      ::fchown(descriptor_, static_cast<uid_t>(-1), status_->st_gid) != 0 && errno != EPERM)
    return false;
  return ::fchmod(descriptor_, status_->st_mode & kModeBits) == 0;
}

/// Syncs the folder, so that the file's entry is on the disk. Errors are ignored: the file itself is complete.
static void sync_folder(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

int OutputFile::sync() {
  if (flush() == 0 && temporary_ && ((status_ && !take_over_attributes()) || ::fsync(descriptor_) != 0)) error_ = errno;
  return error_;
}

int OutputFile::commit() {
  if (sync() != 0 || !temporary_) return error_;
  error_ = temporary_->rename(target_);
  if (error_ == 0) sync_folder(target_.parent_path());
  return error_;
}

std::optional<std::string> commit(OutputFile& output, std::string_view name, dialect::Language language) {
  const int error = output.commit();
  return error == 0 ? std::nullopt : std::optional(fmt::format("{}: {}", name, cannot_write(error, language)));
}

}  // namespace isocnc::system
