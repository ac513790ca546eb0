#include "interpreter/system/file_bytes.h"

#include <cerrno>
#include <new>
#include <optional>

#include "interpreter/system/descriptor.h"
#include "interpreter/system/file_status.h"
#include "interpreter/system/system_texts.h"

namespace isocnc::system {

using Kind = FileBytesProblem::Kind;

std::variant<std::string, FileBytesProblem> read_bytes(const std::filesystem::path& path, std::size_t limit,
                                                       dialect::Language language) {
  const auto unreadable = [&](int error) {
    return FileBytesProblem{.kind = Kind::Unreadable, .message = cannot_read(error, language)};
  };
  const Descriptor file = open_to_read_at_once(path);
  const std::optional<FileStatus> status = file.is_open() ? status_of(file.number()) : std::nullopt;
  if (!status) return unreadable(errno);
  if (status->kind != FileStatus::Kind::Regular) return FileBytesProblem{.kind = Kind::NotRegular, .message = {}};
  if (status->size > limit) return FileBytesProblem{.kind = Kind::TooLarge, .message = {}};
  std::string bytes;
  try {
    bytes.resize(static_cast<std::size_t>(status->size));
  } catch (const std::bad_alloc&) {
    return unreadable(ENOMEM);
  }
  std::size_t size = 0;
  while (size < bytes.size()) {
    const std::ptrdiff_t count = read_some(file.number(), bytes.data() + size, bytes.size() - size);
    if (count < 0) return unreadable(errno);
    if (count == 0) break;  // Another program has cut the file short.
    size += static_cast<std::size_t>(count);
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace isocnc::system
