/* Preloaded into a program under test: clocks that the test sets, and a disk that the test puts to sleep.
 *
 * The test and the program share the file that ISOCNC_SOAK_WORLD names (world.py). Both clocks of the program are those of
 * the system plus an offset each; a wait for a time ends when the shifted clock reaches it, also when the clock jumps.
 * Calls that look at files below `folder` wait while the disk sleeps, and fail with EIO while it is broken.
 *
 * libfaketime 0.9.10 does not shift pthread_cond_clockwait(), with which C++ waits, and moves both clocks together.
 */
#define _GNU_SOURCE
#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <malloc.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

enum { DISK_AWAKE, DISK_ASLEEP, DISK_BROKEN };

/* world.py has the same layout. */
struct world {
  _Atomic int64_t real_offset;       /* Of CLOCK_REALTIME, ns. */
  _Atomic int64_t monotonic_offset;  /* Of CLOCK_MONOTONIC, ns. */
  _Atomic int32_t disk;
  _Atomic int32_t waiting;           /* Calls that wait for the disk now. */
  _Atomic int64_t clock_reads;
  _Atomic int64_t disk_calls;
  _Atomic int32_t trims;             /* Asks that free memory be given back. */
  int32_t unused;
  char folder[4096];
};

/* What goes wrong on purpose, to try the test itself. */
static int leaks_memory;
static int leaks_files;

static struct world nothing;
static struct world* world = &nothing;

enum { MAX_FILE = 4096 };
static _Atomic char is_on_disk[MAX_FILE]; /* By file descriptor. */

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

__attribute__((constructor)) static void start(void) {
  const char* const name = getenv("ISOCNC_SOAK_WORLD");
  const int file = name ? (int)syscall(SYS_openat, AT_FDCWD, name, O_RDWR | O_CLOEXEC) : -1;
  if (file < 0) return;
  void* const shared = mmap(NULL, sizeof(struct world), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  syscall(SYS_close, file);
  if (shared != MAP_FAILED) world = shared;
  const char* const fault = getenv("ISOCNC_SOAK_FAULT");
  leaks_memory = fault && strcmp(fault, "leak") == 0;
  leaks_files = fault && strcmp(fault, "descriptor") == 0;
}

/* ---- Clocks */

static const int64_t kSecond = 1000000000;

static int64_t offset_of(clockid_t clock) {
  switch (clock) {
    case CLOCK_REALTIME:
    case CLOCK_REALTIME_COARSE:
      return world->real_offset;
    case CLOCK_MONOTONIC:
    case CLOCK_MONOTONIC_COARSE:
    case CLOCK_MONOTONIC_RAW:
    case CLOCK_BOOTTIME:
      return world->monotonic_offset;
    default:
      return 0;
  }
}

static int64_t nanoseconds(const struct timespec* time) { return time->tv_sec * kSecond + time->tv_nsec; }

static struct timespec timespec_of(int64_t time) {
  return (struct timespec){.tv_sec = time / kSecond, .tv_nsec = time % kSecond};
}

int clock_gettime(clockid_t clock, struct timespec* time) {
  static __typeof__(&clock_gettime) real;
  if (!real) real = REAL(clock_gettime);
  const int result = real(clock, time);
  const int64_t offset = offset_of(clock);
  const int64_t number = ++world->clock_reads;
  if (world->trims) {
    malloc_trim(0);
    world->trims = 0;
  }
  if (leaks_memory && number % 50 == 0) {
    static const size_t kLeak = 256 * 1024;
    void* volatile leak = malloc(kLeak);
    if (leak) memset(leak, 1, kLeak);
  }
  if (leaks_files && number % 1000 == 0) dup(STDERR_FILENO);
  if (result == 0 && offset != 0) *time = timespec_of(nanoseconds(time) + offset);
  return result;
}

int pthread_cond_clockwait(pthread_cond_t* condition, pthread_mutex_t* mutex, clockid_t clock,
                           const struct timespec* until) {
  static const int64_t kSlice = 10 * 1000 * 1000;
  static __typeof__(&pthread_cond_clockwait) real;
  if (!real) real = REAL(pthread_cond_clockwait);
  for (;;) {
    struct timespec now;
    clock_gettime(clock, &now);
    const int64_t left = nanoseconds(until) - nanoseconds(&now);
    if (left <= 0) return ETIMEDOUT;
    const int64_t end = nanoseconds(&now) - offset_of(clock) + (left < kSlice ? left : kSlice);
    const struct timespec slice_end = timespec_of(end);
    const int result = real(condition, mutex, clock, &slice_end);
    if (result != ETIMEDOUT) return result;
  }
}

/* ---- The disk */

static int is_below_folder(const char* path) {
  const size_t length = strlen(world->folder);
  return length > 0 && path && strncmp(path, world->folder, length) == 0 && (path[length] == '/' || !path[length]);
}

/* Waits until the disk is awake or broken; whether it is broken. */
static int disk_fails(int is_concerned) {
  if (!is_concerned) return 0;
  ++world->disk_calls;
  ++world->waiting;
  while (world->disk == DISK_ASLEEP) {
    const struct timespec moment = {.tv_sec = 0, .tv_nsec = 2 * 1000 * 1000};
    syscall(SYS_nanosleep, &moment, NULL);
  }
  --world->waiting;
  if (world->disk != DISK_BROKEN) return 0;
  errno = EIO;
  return 1;
}

static int is_descriptor_on_disk(int file) { return file >= 0 && file < MAX_FILE && is_on_disk[file]; }

static int path_at_is_on_disk(int folder, const char* path) {
  return path && path[0] == '/' ? is_below_folder(path) : is_descriptor_on_disk(folder);
}

static int noted(int file, int is_concerned) {
  if (file >= 0 && file < MAX_FILE) is_on_disk[file] = (char)is_concerned;
  return file;
}

#define OPEN(name)                                         \
  int name(const char* path, int flags, ...) {             \
    va_list rest;                                          \
    va_start(rest, flags);                                 \
    const mode_t mode = va_arg(rest, mode_t);              \
    va_end(rest);                                          \
    const int is_concerned = is_below_folder(path);        \
    if (disk_fails(is_concerned)) return -1;               \
    return noted(REAL(name)(path, flags, mode), is_concerned); \
  }
OPEN(open)
OPEN(open64)

#define OPENAT(name)                                                 \
  int name(int folder, const char* path, int flags, ...) {           \
    va_list rest;                                                    \
    va_start(rest, flags);                                           \
    const mode_t mode = va_arg(rest, mode_t);                        \
    va_end(rest);                                                    \
    const int is_concerned = path_at_is_on_disk(folder, path);       \
    if (disk_fails(is_concerned)) return -1;                         \
    return noted(REAL(name)(folder, path, flags, mode), is_concerned); \
  }
OPENAT(openat)
OPENAT(openat64)

#define FOPEN(name)                                            \
  FILE* name(const char* path, const char* mode) {             \
    const int is_concerned = is_below_folder(path);            \
    if (disk_fails(is_concerned)) return NULL;                 \
    FILE* const file = REAL(name)(path, mode);                 \
    if (file) noted(fileno(file), is_concerned);               \
    return file;                                               \
  }
FOPEN(fopen)
FOPEN(fopen64)

int close(int file) {
  noted(file, 0);
  return REAL(close)(file);
}

ssize_t read(int file, void* bytes, size_t count) {
  static __typeof__(&read) real;
  if (!real) real = REAL(read);
  return disk_fails(is_descriptor_on_disk(file)) ? -1 : real(file, bytes, count);
}

#define STAT(name, type)                                                                    \
  int name(const char* path, struct type* status) {                                         \
    return disk_fails(is_below_folder(path)) ? -1 : REAL(name)(path, status);               \
  }
STAT(stat, stat)
STAT(stat64, stat64)
STAT(lstat, stat)
STAT(lstat64, stat64)

#define FSTAT(name, type)                                                                   \
  int name(int file, struct type* status) {                                                 \
    return disk_fails(is_descriptor_on_disk(file)) ? -1 : REAL(name)(file, status);         \
  }
FSTAT(fstat, stat)
FSTAT(fstat64, stat64)

int access(const char* path, int mode) {
  return disk_fails(is_below_folder(path)) ? -1 : REAL(access)(path, mode);
}

ssize_t readlink(const char* restrict path, char* restrict text, size_t size) {
  return disk_fails(is_below_folder(path)) ? -1 : REAL(readlink)(path, text, size);
}

char* realpath(const char* restrict path, char* restrict resolved) {
  return disk_fails(is_below_folder(path)) ? NULL : REAL(realpath)(path, resolved);
}

DIR* opendir(const char* path) { return disk_fails(is_below_folder(path)) ? NULL : REAL(opendir)(path); }

struct dirent* readdir(DIR* folder) {
  return disk_fails(is_descriptor_on_disk(dirfd(folder))) ? NULL : REAL(readdir)(folder);
}
