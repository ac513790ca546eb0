#include "interpreter/running/write_atomically.h"

#include <unistd.h>

#include <string>
#include <system_error>

#include "interpreter/running/output_file.h"
#include "interpreter/running/temporary_file.h"

namespace isocnc::running {

namespace fs = std::filesystem;

static int write_file(const fs::path& path, std::string_view text, bool to_disk) {
  OutputFile file(path);
  file.write(text);
  return to_disk ? file.sync() : file.flush();
}

int write_atomically(const fs::path& path, std::string_view text) {
  std::error_code error;
  const fs::file_status before = fs::status(path, error);
  error.clear();  // There need be no file yet.
  // A device or a pipe is written to, never replaced.
  if (fs::exists(before) && !fs::is_regular_file(before)) return write_file(path, text, false);
  // Of a symlink the file that it names is replaced, not the link.
  const fs::path target = fs::exists(before) ? fs::canonical(path, error) : path;
  if (error) return error.value();
  TemporaryFile beside(target.string() + ".new-" + std::to_string(::getpid()));
  if (const int failure = write_file(beside.path(), text, true)) return failure;
  if (fs::exists(before)) fs::permissions(beside.path(), before.permissions(), error);
  return beside.rename(target);
}

}  // namespace isocnc::running
