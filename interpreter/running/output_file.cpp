#include "interpreter/running/output_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

#include <fmt/format.h>

#include "interpreter/running/system_texts.h"

namespace isocnc::running {

OutputFile::OutputFile(const std::filesystem::path& path) : is_ours_(true) {
  do {
    descriptor_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  } while (descriptor_ < 0 && errno == EINTR);
  if (descriptor_ < 0) error_ = errno;
}

OutputFile::~OutputFile() {
  if (is_ours_ && descriptor_ >= 0) ::close(descriptor_);
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

int OutputFile::sync() {
  if (flush() == 0 && ::fsync(descriptor_) != 0) error_ = errno;
  return error_;
}

std::optional<std::string> flush(OutputFile& output, std::string_view name, dialect::Language language) {
  const int error = output.flush();
  return error == 0 ? std::nullopt : std::optional(fmt::format("{}: {}", name, cannot_write(error, language)));
}

}  // namespace isocnc::running
