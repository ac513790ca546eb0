#include "interpreter/system/descriptor.h"

#include <windows.h>

#include <fcntl.h>
#include <io.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>

#include "interpreter/system/windows/errors.h"
#include "interpreter/system/windows/handle.h"

namespace isocnc::system {

/// What one call reads or writes at most: its counts are of 32 bits.
static constexpr std::size_t kLargest = std::size_t{1} << 30;

static Descriptor open(const std::filesystem::path& path, DWORD access, DWORD how, int flags) {
  HANDLE const file = open_shared(path, access, how);
  if (file == INVALID_HANDLE_VALUE) return Descriptor();
  const int number = ::_open_osfhandle(reinterpret_cast<std::intptr_t>(file), flags | _O_BINARY | _O_NOINHERIT);
  if (number < 0) ::CloseHandle(file);
  return Descriptor(number);
}

Descriptor::~Descriptor() {
  if (is_open()) ::_close(number_);
}

Descriptor open_to_read(const std::filesystem::path& path) {
  return open(path, GENERIC_READ, OPEN_EXISTING, _O_RDONLY);
}

Descriptor open_to_read_at_once(const std::filesystem::path& path) { return open_to_read(path); }

Descriptor open_to_append(const std::filesystem::path& path) {
  return open(path, FILE_APPEND_DATA, OPEN_ALWAYS, _O_WRONLY | _O_APPEND);
}

/// A new file has the rights of its folder; take_over_attributes() gives it those of the file that it replaces.
Descriptor create_file(const std::filesystem::path& path, Access) {
  return open(path, GENERIC_WRITE | WRITE_DAC, CREATE_NEW, _O_WRONLY);
}

std::ptrdiff_t read_some(int descriptor, char* bytes, std::size_t size) {
  DWORD count = 0;
  if (::ReadFile(handle_of(descriptor), bytes, static_cast<DWORD>(std::min(size, kLargest)), &count, nullptr) != 0)
    return static_cast<std::ptrdiff_t>(count);
  keep_last_error();
  return errno == EPIPE ? 0 : -1;  // All writers have closed the pipe.
}

/// Not by _write(), which calls a closed pipe an invalid argument.
std::ptrdiff_t write_some(int descriptor, std::string_view bytes) {
  DWORD count = 0;
  const auto size = static_cast<DWORD>(std::min(bytes.size(), kLargest));
  if (::WriteFile(handle_of(descriptor), bytes.data(), size, &count, nullptr) != 0)
    return static_cast<std::ptrdiff_t>(count);
  keep_last_error();
  return -1;
}

bool write_to_disk(int descriptor) { return ::_commit(descriptor) == 0; }

}  // namespace isocnc::system
