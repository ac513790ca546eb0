#pragma once

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

namespace isocnc::support {

/// Runs `act` in a process of its own that is no superuser, and may write no more than so many bytes to a file: a disk
/// that fills up. 0 when `act` says true, 1 when it says false, -1 when a signal ended it.
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

/// Whether what runs in a child may start this program: the build may stand in a folder of the superuser's own.
inline bool child_may_run(const char* program) {
  return in_child([&] { return ::access(program, X_OK) == 0; }) == 0;
}

}  // namespace isocnc::support
