#include "interpreter/running/temporary_file.h"

#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <utility>

namespace isocnc::running {

/// The names in use, for the handler of a signal, which may take no lock. A file that finds no place may be left
/// behind.
static std::array<std::atomic<const char*>, 256> temporary_names;

TemporaryFile::TemporaryFile(std::string path) : path_(std::move(path)) {
  for (std::atomic<const char*>& place : temporary_names) {
    const char* nobody = nullptr;
    if (place.compare_exchange_strong(nobody, path_.c_str())) break;
  }
}

TemporaryFile::~TemporaryFile() {
  if (!is_renamed_) ::unlink(path_.c_str());
  for (std::atomic<const char*>& place : temporary_names) {
    const char* own = path_.c_str();
    if (place.compare_exchange_strong(own, nullptr)) break;
  }
}

int TemporaryFile::rename(const std::filesystem::path& path) {
  if (std::rename(path_.c_str(), path.c_str()) != 0) return errno;
  is_renamed_ = true;
  return 0;
}

void remove_temporary_files() {
  for (const std::atomic<const char*>& place : temporary_names)
    if (const char* const name = place.load()) ::unlink(name);
}

/// Then the signal does what it would have done.
static void on_end(int signal) {
  remove_temporary_files();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

void leave_no_temporary_files() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    if (std::signal(signal, on_end) == SIG_IGN) std::signal(signal, SIG_IGN);  // As under nohup.
}

}  // namespace isocnc::running
