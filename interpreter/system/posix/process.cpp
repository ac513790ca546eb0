#include "interpreter/system/process.h"

#include <fcntl.h>
#include <malloc.h>
#include <poll.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <thread>

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

static constexpr std::array kEndSignals = {SIGINT, SIGTERM, SIGHUP};

void before_forced_end(void (*clean_up)()) {
  clean_up_before_end = clean_up;
  for (const int signal : kEndSignals)
    // Keeps an ignored signal ignored, as under nohup.
    if (std::signal(signal, on_end) == SIG_IGN) std::signal(signal, SIG_IGN);
}

// NOLINTBEGIN(cppcoreguidelines-avoid-non-const-global-variables): a handler sees nothing else.
static volatile std::sig_atomic_t end_is_requested = 0;
static std::array<int, 2> end_request_pipe = {-1, -1};
static std::array<void (*)(int), kEndSignals.size()> handlers_before{};
// NOLINTEND(cppcoreguidelines-avoid-non-const-global-variables)

/// Wakes a sleeping program by a byte in the pipe, which no one reads.
static void on_end_request(int) {
  const int error = errno;
  end_is_requested = 1;
  for (std::size_t i = 0; i < kEndSignals.size(); ++i) std::signal(kEndSignals.at(i), handlers_before.at(i));
  [[maybe_unused]] const ssize_t written = ::write(end_request_pipe[1], "", 1);
  errno = error;
}

bool take_end_request() {
  if (::pipe2(end_request_pipe.data(), O_CLOEXEC | O_NONBLOCK) != 0) return false;
  for (std::size_t i = 0; i < kEndSignals.size(); ++i) {
    handlers_before.at(i) = std::signal(kEndSignals.at(i), SIG_IGN);
    // Keeps an ignored signal ignored, as under nohup.
    if (handlers_before.at(i) != SIG_IGN) std::signal(kEndSignals.at(i), on_end_request);
  }
  return true;
}

bool is_end_requested() { return end_is_requested != 0; }

bool sleep_until_end_request(std::chrono::milliseconds longest) {
  pollfd end = {.fd = end_request_pipe[0], .events = POLLIN, .revents = 0};
  ::poll(&end, 1, static_cast<int>(longest.count()));
  return is_end_requested();
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

int processor_count() {
#ifdef CPU_COUNT  // Not all systems tell.
  cpu_set_t usable;
  if (::sched_getaffinity(0, sizeof usable, &usable) == 0) return std::max(1, CPU_COUNT(&usable));
#endif
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

bool is_running(std::int64_t process) { return ::kill(static_cast<pid_t>(process), 0) == 0 || errno != ESRCH; }

std::filesystem::path program_file() {
  std::error_code error;
  const std::filesystem::path file = std::filesystem::read_symlink("/proc/self/exe", error);
  return error ? std::filesystem::path() : file;
}

std::string user_locale() { return {}; }

}  // namespace isocnc::system
