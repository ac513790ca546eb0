#include "interpreter/running/replace_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>

#include "interpreter/running/system_texts.h"

namespace isocnc::running {

using dialect::Language;
using dialect::Text;

static constexpr Text kNotRegular{"is no regular file", "non è un file regolare"};
static constexpr Text kHasOtherNames{"has other names (hard links), which would keep the old text; left as it is",
                                     "ha altri nomi (hard link), che terrebbero il testo vecchio: resta com'è"};
static constexpr Text kHasChanged{"has been changed meanwhile by another program; left as it is",
                                  "è stato modificato nel frattempo da un altro programma: resta com'è"};

/// Permissions: what chmod can set.
static constexpr mode_t kModeBits = 07777;

FileReplacement::FileReplacement(const std::filesystem::path& path) {
  std::error_code error;
  target_ = std::filesystem::canonical(path, error);
  if (error) {
    error_ = error.value();
  } else if (::stat(target_.c_str(), &status_) != 0) {
    error_ = errno;
  } else if (!S_ISREG(status_.st_mode)) {
    refusal_ = &kNotRegular;
  } else if (status_.st_nlink > 1) {
    refusal_ = &kHasOtherNames;
  } else if (::access(target_.c_str(), W_OK) != 0) {
    error_ = errno;  // A rename would not ask.
  }
}

FileReplacement::~FileReplacement() { discard(); }

void FileReplacement::discard() {
  output_.reset();
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
  temporary_.reset();
}

/// Its name ends in no extension of programs, should it ever be left behind.
void FileReplacement::make_temporary() {
  std::string name = target_.parent_path() / ("." + target_.filename().string().substr(0, 200) + ".isocnc-XXXXXX");
  descriptor_ = ::mkostemp(name.data(), O_CLOEXEC);
  if (descriptor_ >= 0) {
    temporary_.emplace(std::move(name));
    output_.emplace(descriptor_);
  } else {
    error_ = errno;
  }
}

void FileReplacement::write(std::string_view text) {
  if (error_ != 0 || refusal_ != nullptr) return;
  if (descriptor_ < 0) make_temporary();
  if (output_) output_->write(text);
}

/// The mode comes last, since a change of owner takes bits from it.
bool FileReplacement::take_over_attributes() const {
  struct stat now {};
  if (::fstat(descriptor_, &now) != 0) return false;
  const bool is_others = now.st_uid != status_.st_uid || now.st_gid != status_.st_gid;
  // Not all may give files away; whoever may write the file may at least keep its group.
  if (is_others && ::fchown(descriptor_, status_.st_uid, status_.st_gid) != 0 &&
      ::fchown(descriptor_, static_cast<uid_t>(-1), status_.st_gid) != 0 && errno != EPERM)
    return false;
  return ::fchmod(descriptor_, status_.st_mode & kModeBits) == 0;
}

bool FileReplacement::is_unchanged() const {
  struct stat now {};
  return ::stat(target_.c_str(), &now) == 0 && now.st_dev == status_.st_dev && now.st_ino == status_.st_ino &&
         now.st_size == status_.st_size && now.st_mtim.tv_sec == status_.st_mtim.tv_sec &&
         now.st_mtim.tv_nsec == status_.st_mtim.tv_nsec;
}

std::string FileReplacement::why_not(Language language) const {
  return refusal_ != nullptr ? std::string(refusal_->in(language)) : cannot_write(error_, language);
}

/// The folder's entry is on the disk when the folder is. What fails here is told by nobody: the file is whole.
static void sync_folder(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

std::optional<std::string> FileReplacement::commit(Language language) {
  write({});  // The new text may be empty.
  if (error_ == 0 && refusal_ == nullptr) {
    error_ = output_->flush();
    if (error_ == 0 && (!take_over_attributes() || ::fsync(descriptor_) != 0)) error_ = errno;
    if (error_ == 0 && !is_unchanged()) refusal_ = &kHasChanged;
    if (error_ == 0 && refusal_ == nullptr) error_ = temporary_->rename(target_);
  }
  discard();
  if (error_ != 0 || refusal_ != nullptr) return why_not(language);
  sync_folder(target_.parent_path());
  return std::nullopt;
}

}  // namespace isocnc::running
