#include "interpreter/system/descriptor.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

namespace isocnc::system {

static Descriptor open(const std::filesystem::path& path, int flags, mode_t mode = 0) {
  int number = -1;
  do {
    number = ::open(path.c_str(), flags | O_CLOEXEC, mode);
  } while (number < 0 && errno == EINTR);
  return Descriptor(number);
}

Descriptor::~Descriptor() {
  if (is_open()) ::close(number_);
}

Descriptor open_to_read(const std::filesystem::path& path) { return open(path, O_RDONLY); }

Descriptor open_to_read_at_once(const std::filesystem::path& path) { return open(path, O_RDONLY | O_NONBLOCK); }

Descriptor open_to_append(const std::filesystem::path& path) { return open(path, O_WRONLY | O_CREAT | O_APPEND, 0666); }

Descriptor create_file(const std::filesystem::path& path, Access access) {
  return open(path, O_WRONLY | O_CREAT | O_EXCL, access == Access::Private ? 0600 : 0666);
}

std::ptrdiff_t read_some(int descriptor, char* bytes, std::size_t size) {
  ssize_t count = -1;
  do {
    count = ::read(descriptor, bytes, size);
  } while (count < 0 && errno == EINTR);
  return count;
}

std::ptrdiff_t write_some(int descriptor, std::string_view bytes) {
  ssize_t count = -1;
  do {
    count = ::write(descriptor, bytes.data(), bytes.size());
  } while (count < 0 && errno == EINTR);
  return count;
}

bool write_to_disk(int descriptor) { return ::fsync(descriptor) == 0; }

}  // namespace isocnc::system
