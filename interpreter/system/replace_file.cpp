#include "interpreter/system/replace_file.h"

#include <cerrno>

#include "interpreter/system/paths.h"
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
  target_ = system::canonical(path, error);
  if (error) {
    error_ = error.default_error_condition().value();
    return;
  }
  const std::optional<FileStatus> status = status_of(target_);
  if (!status) {
    error_ = errno;
  } else if (status->kind != FileStatus::Kind::Regular) {
    refusal_ = &kNotRegular;
  } else if (status->names > 1) {
    refusal_ = &kHasOtherNames;
  } else if (!may_write(target_)) {
    error_ = errno;  // A rename does not check write access.
  } else {
    status_ = *status;
  }
}

void FileReplacement::write(std::string_view text) {
  if (error_ != 0 || refusal_ != nullptr) return;
  if (!output_) output_.emplace(target_);
  output_->write(text);
}

/// What others have done to the file meanwhile that forbids replacing it; null for nothing.
const Text* FileReplacement::change_meanwhile() const {
  const std::optional<FileStatus> now = status_of(target_);
  if (!now || !now->is_unchanged_since(status_)) return &kHasChanged;
  return now->names > 1 ? &kHasOtherNames : nullptr;
}

std::string FileReplacement::why_not(Language language) const {
  return refusal_ != nullptr ? std::string(refusal_->in(language)) : cannot_write(error_, language);
}

std::optional<std::string> FileReplacement::commit(Language language) {
  write({});  // The new text may be empty.
  if (output_) error_ = output_->sync();
  if (error_ == 0 && refusal_ == nullptr) refusal_ = change_meanwhile();
  if (error_ == 0 && refusal_ == nullptr) error_ = output_->commit();
  output_.reset();
  return error_ != 0 || refusal_ != nullptr ? std::optional(why_not(language)) : std::nullopt;
}

}  // namespace isocnc::system
