#include "interpreter/system/replace_file.h"

#include <unistd.h>

#include <cerrno>

#include "interpreter/system/system_texts.h"

namespace isocnc::system {

using dialect::Language;
using dialect::Text;

static constexpr Text kNotRegular{"is not a regular file", "non è un file regolare"};
static constexpr Text kHasOtherNames{"has other names (hard links), which would keep the old text; left as it is",
                                     "ha altri nomi (hard link), che terrebbero il testo vecchio: resta com'è"};
static constexpr Text kHasChanged{"has been changed meanwhile by another program; left as it is",
                                  "è stato modificato nel frattempo da un altro programma: resta com'è"};

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
    error_ = errno;  // A rename does not check write access.
  }
}

void FileReplacement::write(std::string_view text) {
  if (error_ != 0 || refusal_ != nullptr) return;
  if (!output_) output_.emplace(target_);
  output_->write(text);
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

std::optional<std::string> FileReplacement::commit(Language language) {
  write({});  // The new text may be empty.
  if (output_) error_ = output_->sync();
  if (error_ == 0 && refusal_ == nullptr && !is_unchanged()) refusal_ = &kHasChanged;
  if (error_ == 0 && refusal_ == nullptr) error_ = output_->commit();
  output_.reset();
  return error_ != 0 || refusal_ != nullptr ? std::optional(why_not(language)) : std::nullopt;
}

}  // namespace isocnc::system
