#include "interpreter/system/process.h"

#include <malloc.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

namespace isocnc::system {

void prepare_process() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

ProgramArguments::ProgramArguments(int argc, char** argv) : pointers_(argv, argv + argc) {
  pointers_.push_back(nullptr);
}

// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): a handler sees nothing else.
static void (*clean_up_before_end)() = nullptr;

/// Cleans up, then lets the signal take its default effect.
static void on_end(int signal) {
  clean_up_before_end();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

void before_forced_end(void (*clean_up)()) {
  clean_up_before_end = clean_up;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    // Keeps an ignored signal ignored, as under nohup.
    if (std::signal(signal, on_end) == SIG_IGN) std::signal(signal, SIG_IGN);
}

void share_one_heap() {
#ifdef __GLIBC__
  // NOLINTBEGIN(concurrency-mt-unsafe): there is one thread yet.
  mallopt(M_ARENA_MAX, 1);
  mallopt(M_TOP_PAD, 8 << 20);
  mallopt(M_TRIM_THRESHOLD, 16 << 20);
  mallopt(M_MMAP_THRESHOLD, 4 << 20);
  // NOLINTEND(concurrency-mt-unsafe)
#endif
}

bool has_threads() { return true; }

bool is_running(std::int64_t process) { return ::kill(static_cast<pid_t>(process), 0) == 0 || errno != ESRCH; }

std::filesystem::path program_file() {
  std::error_code error;
  const std::filesystem::path file = std::filesystem::read_symlink("/proc/self/exe", error);
  return error ? std::filesystem::path() : file;
}

std::string user_locale() { return {}; }

}  // namespace isocnc::system
