#include "interpreter/system/temporary_file.h"

#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <utility>

#include "interpreter/system/handler_table.h"

namespace isocnc::system {

/// The names in use. A file that finds no free slot may be left behind.
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): a handler sees nothing else.
static HandlerTable<char> temporary_names;

TemporaryFile::TemporaryFile(std::string path) : path_(std::move(path)) { temporary_names.add(path_.c_str()); }

TemporaryFile::~TemporaryFile() {
  if (!is_renamed_) ::unlink(path_.c_str());
  temporary_names.remove(path_.c_str());
}

int TemporaryFile::rename(const std::filesystem::path& path) {
  if (std::rename(path_.c_str(), path.c_str()) != 0) return errno;
  is_renamed_ = true;
  return 0;
}

void remove_temporary_files() {
  temporary_names.for_each([](const char& name) { ::unlink(&name); });
}

/// Removes the temporary files, then lets the signal take its default effect.
static void on_end(int signal) {
  remove_temporary_files();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

void leave_no_temporary_files() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    // Keeps an ignored signal ignored, as under nohup.
    if (std::signal(signal, on_end) == SIG_IGN) std::signal(signal, SIG_IGN);
}

}  // namespace isocnc::system
