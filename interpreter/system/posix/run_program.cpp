#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>

#include "interpreter/system/descriptor.h"
#include "interpreter/system/process.h"

namespace isocnc::system {

namespace {

struct Pipe {
  Descriptor read_end;
  Descriptor write_end;

  /// Returns 0 or the errno.
  int open() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) return errno;
    read_end = Descriptor(ends[0]);
    write_end = Descriptor(ends[1]);
    return 0;
  }
};

/// The pipes of another program.
struct Streams {
  Pipe input;
  Pipe output;
  Pipe errors;
};

/// Starts the program; returns 0 or the errno.
int start(const std::vector<std::string>& command, const Streams& streams, pid_t& process) {
  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
  posix_spawn_file_actions_init(&actions);
  posix_spawnattr_init(&attributes);
  posix_spawn_file_actions_adddup2(&actions, streams.input.read_end.number(), kStandardInput);
  posix_spawn_file_actions_adddup2(&actions, streams.output.write_end.number(), kStandardOutput);
  posix_spawn_file_actions_adddup2(&actions, streams.errors.write_end.number(), kStandardError);
  // We ignore these (prepare_process), which would be inherited.
  sigset_t defaults;
  sigemptyset(&defaults);
  sigaddset(&defaults, SIGPIPE);
  sigaddset(&defaults, SIGXFSZ);
  posix_spawnattr_setsigdefault(&attributes, &defaults);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  std::vector<std::string> words = command;
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const int error = ::posix_spawnp(&process, arguments[0], &actions, &attributes, arguments.data(), ::environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  return error;
}

/// Takes what there is to read, and closes the descriptor at its end.
void take(Descriptor& from, std::string& text) {
  std::array<char, 64 * 1024> bytes{};
  const std::ptrdiff_t count = read_some(from.number(), bytes.data(), bytes.size());
  if (count > 0) {
    text.append(bytes.data(), static_cast<std::size_t>(count));
  } else {
    from = Descriptor();
  }
}

/// Gives what the pipe takes without waiting, and closes it after the last byte, or when nobody reads it.
void give(Descriptor& to, std::string_view& text) {
  const std::ptrdiff_t count = text.empty() ? 0 : write_some(to.number(), text);
  if (count < 0 && errno == EAGAIN) return;
  if (count > 0) text.remove_prefix(static_cast<std::size_t>(count));
  if (count < 0 || text.empty()) to = Descriptor();
}

/// Writes and reads at once, so that neither program waits for the other.
void converse(Streams& streams, std::string_view input, ProgramEnd& end) {
  Descriptor& to = streams.input.write_end;
  Descriptor& output = streams.output.read_end;
  Descriptor& errors = streams.errors.read_end;
  ::fcntl(to.number(), F_SETFL, O_NONBLOCK);
  while (to.is_open() || output.is_open() || errors.is_open()) {
    // Those below 0 are left out.
    std::array<pollfd, 3> polled{
        {{to.number(), POLLOUT, 0}, {output.number(), POLLIN, 0}, {errors.number(), POLLIN, 0}}};
    if (::poll(polled.data(), polled.size(), -1) < 0) continue;  // A signal came.
    if (polled[0].revents != 0) give(to, input);
    if (polled[1].revents != 0) take(output, end.output);
    if (polled[2].revents != 0) take(errors, end.errors);
  }
}

/// Lets the system keep the status of other programs, which it does not where we have been started without SIGCHLD.
class KeptStatus {
 public:
  KeptStatus() : before_(std::signal(SIGCHLD, SIG_DFL)) {}
  KeptStatus(const KeptStatus&) = delete;
  KeptStatus& operator=(const KeptStatus&) = delete;
  ~KeptStatus() { std::signal(SIGCHLD, before_); }

  static int of(pid_t process) {
    int status = 0;
    while (::waitpid(process, &status, 0) < 0)
      if (errno != EINTR) return 1;
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  }

 private:
  void (*before_)(int);
};

}  // namespace

std::variant<ProgramEnd, std::error_code> run_program(const std::vector<std::string>& command, std::string_view input) {
  Streams streams;
  for (Pipe* const pipe : {&streams.input, &streams.output, &streams.errors})
    if (const int error = pipe->open()) return std::error_code(error, std::generic_category());
  const KeptStatus kept;
  pid_t process = 0;
  if (const int error = start(command, streams, process)) return std::error_code(error, std::generic_category());
  streams.input.read_end = Descriptor();
  streams.output.write_end = Descriptor();
  streams.errors.write_end = Descriptor();
  ProgramEnd end;
  converse(streams, input, end);
  end.status = KeptStatus::of(process);
  return end;
}

}  // namespace isocnc::system
