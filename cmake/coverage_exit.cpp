// A program that ends without its destructors has counted its lines as well. In a build that counts, this stands in for
// what the C library would do at once.

#include <sys/syscall.h>
#include <unistd.h>

extern "C" void __gcov_dump();

[[noreturn]] static void end_counted(int status) {
  __gcov_dump();
  for (;;) ::syscall(SYS_exit_group, status);
}

extern "C" void _exit(int status) { end_counted(status); }
extern "C" void _Exit(int status) noexcept { end_counted(status); }
