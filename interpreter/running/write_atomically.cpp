#include "interpreter/running/write_atomically.h"

#include <unistd.h>

#include <string>
#include <system_error>

#include "interpreter/running/output_file.h"

namespace isocnc::running {

namespace fs = std::filesystem;

static int write_file(const fs::path& path, std::string_view text) {
  OutputFile file(path);
  file.write(text);
  return file.flush();
}

int write_atomically(const fs::path& path, std::string_view text) {
  std::error_code error;
  const fs::file_status before = fs::status(path, error);
  error.clear();  // There need be no file yet.
  // A device or a pipe is written to, never replaced.
  if (fs::exists(before) && !fs::is_regular_file(before)) return write_file(path, text);
  // Of a symlink the file that it names is replaced, not the link.
  const fs::path target = fs::exists(before) ? fs::canonical(path, error) : path;
  if (error) return error.value();
  const fs::path beside = target.string() + ".new-" + std::to_string(::getpid());
  int failure = write_file(beside, text);
  if (failure == 0 && fs::exists(before)) fs::permissions(beside, before.permissions(), error);
  if (failure == 0) {
    fs::rename(beside, target, error);
    failure = error.value();
  }
  if (failure != 0) fs::remove(beside, error);
  return failure;
}

}  // namespace isocnc::running
