#pragma once

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

namespace isocnc::support {

/// Runs `act` in a child process without superuser rights that can write at most `max_bytes` to a file, as on a full
/// disk. Returns 0 if `act` returns true, 1 if it returns false, -1 if a signal ended the process.
template <class Act>
int in_child(Act act, rlim_t max_bytes = RLIM_INFINITY) {
  const pid_t child = ::fork();
  if (child == 0) {
    const rlimit limit{max_bytes, max_bytes};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    ::signal(SIGXFSZ, SIG_DFL);
    if (::geteuid() == 0 && ::setuid(65534) != 0) ::_exit(99);
    ::_exit(act() ? 0 : 1);
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// Whether a child process may start this program: the build may be in a folder that only the superuser can read.
inline bool child_may_run(const char* program) {
  return in_child([&] { return ::access(program, X_OK) == 0; }) == 0;
}

}  // namespace isocnc::support
