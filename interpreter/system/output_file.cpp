#include "interpreter/system/output_file.h"

#include <cerrno>
#include <random>

#include <fmt/format.h>

#include "interpreter/system/same_file.h"
#include "interpreter/system/system_texts.h"

namespace isocnc::system {

namespace fs = std::filesystem;

OutputFile::OutputFile(const fs::path& path) {
  const std::optional<FileStatus> status = status_of(path);
  if (!status && errno != ENOENT) {
    error_ = errno;
  } else if (status && (status->kind != FileStatus::Kind::Regular || names_descriptor(path))) {
    open_in_place(path);
  } else {
    status_ = status;
    target_ = place_of(path);
    open_beside();
  }
  descriptor_ = file_.number();
}

void OutputFile::open_in_place(const fs::path& path) {
  file_ = open_to_append(path);
  if (!file_.is_open()) error_ = errno;
}

/// Opens a file with an unpredictable name that has no extension of programs, in case it is left behind.
void OutputFile::open_beside() {
  constexpr int kAttempts = 100;
  if (status_ && !may_write(target_)) {  // A rename does not check write access.
    error_ = errno;
    return;
  }
  const std::string start = "." + target_.filename().generic_string().substr(0, 200) + ".isocnc-";
  std::random_device random;
  for (int i = 0; i < kAttempts && !file_.is_open(); ++i) {
    fs::path name = target_.parent_path() / fmt::format("{}{:08x}", start, random());
    // Other users must not read a replacement of a file that they may not read.
    file_ = create_file(name, status_ ? Access::Private : Access::Usual);
    if (file_.is_open()) {
      temporary_.emplace(std::move(name));
    } else if (errno != EEXIST) {
      break;
    }
  }
  if (!file_.is_open()) error_ = errno;
}

void OutputFile::write(std::string_view text) {
  if (error_ != 0) return;
  gathered_ += text;
  if (gathered_.size() >= kLarge) flush();
}

int OutputFile::flush() {
  std::string_view rest = gathered_;
  while (!rest.empty() && error_ == 0) {
    const std::ptrdiff_t count = write_some(descriptor_, rest);
    if (count >= 0) {
      rest.remove_prefix(static_cast<std::size_t>(count));
    } else {
      error_ = errno;
    }
  }
  gathered_.clear();
  return error_;
}

int OutputFile::sync() {
  if (flush() != 0 || !temporary_) return error_;
  const bool is_good = !status_ || take_over_attributes(descriptor_, target_, *status_);
  if (!is_good || !write_to_disk(descriptor_)) error_ = errno;
  return error_;
}

int OutputFile::commit() {
  if (sync() == 0 && temporary_) error_ = temporary_->rename(target_);
  return error_;
}

std::optional<std::string> commit(OutputFile& output, std::string_view name, dialect::Language language) {
  const int error = output.commit();
  return error == 0 ? std::nullopt : std::optional(fmt::format("{}: {}", name, cannot_write(error, language)));
}

}  // namespace isocnc::system
