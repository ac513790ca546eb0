#include "interpreter/system/source_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <limits>
#include <new>
#include <optional>

#include "interpreter/system/descriptor.h"
#include "interpreter/system/file_status.h"
#include "interpreter/system/system_texts.h"

namespace isocnc::system {

using dialect::Language;
using dialect::Text;

static constexpr Text kIsDirectory{"is a directory", "è una directory"};
static constexpr Text kIsUtf16{"is UTF-16; save it as UTF-8 or ASCII", "è in UTF-16: va salvato in UTF-8 o ASCII"};
static constexpr Text kIsUtf32{"is UTF-32; save it as UTF-8 or ASCII", "è in UTF-32: va salvato in UTF-8 o ASCII"};
static constexpr Text kIsBinary{"looks like a binary file", "sembra un file binario"};
static constexpr Text kHasEndlessLine{"has a line of 4 GiB or more", "ha una riga di 4 GiB o più"};

/// Number of bytes inspected to recognize binary data and wide encodings.
static constexpr std::size_t kHeadBytes = 8 * 1024;
static constexpr std::size_t kEncodingBytes = 4 * 1024;
/// Maximum size of a file that is read. Larger ones are mapped, which saves memory; they are rarely saved while in use.
static constexpr std::size_t kMaxReadBytes = std::size_t{8} * 1024 * 1024;
static constexpr std::size_t kLongestLine = std::numeric_limits<std::uint32_t>::max();

static bool ends_line(char c) { return c == '\n' || c == '\r'; }

/// Searches backward from the first byte that would make the line too long, so that of many short lines only the last
/// is inspected.
bool has_line_longer_than(std::size_t limit, std::string_view text) {
  while (text.size() > limit) {
    std::size_t end = limit;
    while (!ends_line(text[end]))
      if (end-- == 0) return true;
    text.remove_prefix(end + 1);
  }
  return false;
}

/// Bits for those of four neighboring bytes that are nearly always NUL where the others seldom are; 0 if they differ
/// less.
static unsigned null_columns(std::string_view text) {
  std::array<std::size_t, 4> nulls{};
  for (std::size_t i = 0; i < text.size(); ++i) nulls[i % 4] += text[i] == '\0' ? 1 : 0;
  unsigned columns = 0;
  for (std::size_t i = 0; i < nulls.size(); ++i) {
    const std::size_t all = (text.size() + 3 - i) / 4;
    if (10 * nulls[i] >= 9 * all) {
      columns |= 1U << i;
    } else if (10 * nulls[i] > all) {
      return 0;
    }
  }
  return columns;
}

/// Recognizes UTF-16 or UTF-32 by its byte-order mark, or by the position of NULs in Latin letters.
static std::optional<Text> wide_encoding(std::string_view text) {
  using namespace std::string_view_literals;
  if (text.starts_with("\xFF\xFE\0\0"sv) || text.starts_with("\0\0\xFE\xFF"sv)) return kIsUtf32;
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) return kIsUtf16;
  text = text.substr(0, kEncodingBytes);
  if (text.size() < 4) return std::nullopt;
  switch (null_columns(text)) {
    case 0b0101:
    case 0b1010:
      return kIsUtf16;
    case 0b0111:
    case 0b1110:
      return kIsUtf32;
    default:
      return std::nullopt;
  }
}

static bool is_foreign_control(char c) {
  static constexpr std::string_view kControlsOfText = "\t\r\n\f\x1A";
  return (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) && kControlsOfText.find(c) == std::string_view::npos;
}

/// Compressed data contains all 256 values, so just above a tenth are controls, and more NULs than stray into a text.
static bool looks_binary(std::string_view head) {
  const auto controls = static_cast<std::size_t>(std::count_if(head.begin(), head.end(), is_foreign_control));
  const auto nulls = static_cast<std::size_t>(std::count(head.begin(), head.end(), '\0'));
  const bool many_controls = controls > 1 && 10 * controls > head.size();
  const bool many_nulls = nulls >= 8 && 512 * nulls > head.size();
  return many_controls || many_nulls;
}

/// The reason why the first bytes cannot belong to a program.
static std::optional<Text> obstacle_in_head(std::string_view text) {
  if (const std::optional<Text> encoding = wide_encoding(text)) return encoding;
  if (looks_binary(text.substr(0, kHeadBytes))) return kIsBinary;
  return std::nullopt;
}

static SourceFile::Problem unreadable(int error, Language language) {
  return {.message = cannot_read(error, language), .is_in_use = error == EBUSY};
}

/// Makes room for `capacity` bytes.
static bool grow(SourceFile::ReadBytes& bytes, std::size_t capacity) {
  try {
    auto larger = std::make_unique_for_overwrite<char[]>(capacity);
    std::copy_n(bytes.data.get(), bytes.size, larger.get());
    bytes.data = std::move(larger);
  } catch (const std::bad_alloc&) {
    return false;
  }
  return true;
}

/// Appends bytes of the stream until there are `limit` bytes or it ends, with memory for `expected` bytes; returns 0 or
/// the errno.
static int read_up_to(std::size_t limit, std::size_t expected, int descriptor, SourceFile::ReadBytes& bytes) {
  static constexpr std::size_t kFirstBytes = 64 * 1024;
  std::size_t capacity = bytes.size;
  while (bytes.size < limit) {
    if (bytes.size == capacity) {
      const std::size_t wanted = bytes.size < expected ? expected + 1 : std::max(kFirstBytes, 2 * bytes.size);
      capacity = std::min(limit, wanted);
      if (!grow(bytes, capacity)) return ENOMEM;
    }
    const std::ptrdiff_t count = read_some(descriptor, bytes.data.get() + bytes.size, capacity - bytes.size);
    if (count < 0) return errno;
    if (count == 0) break;
    bytes.size += static_cast<std::size_t>(count);
  }
  return 0;
}

std::variant<SourceFile, SourceFile::Problem> SourceFile::open(const std::filesystem::path& path, Language language) {
  return open(path, kMaxReadBytes, language);
}

std::variant<SourceFile, SourceFile::Problem> SourceFile::open_unmapped(const std::filesystem::path& path,
                                                                        Language language) {
  return open(path, std::numeric_limits<std::size_t>::max(), language);
}

std::variant<SourceFile, SourceFile::Problem> SourceFile::open(const std::filesystem::path& path,
                                                               std::size_t max_read_bytes, Language language) {
  const Descriptor file = open_to_read(path);
  const std::optional<FileStatus> status = file.is_open() ? status_of(file.number()) : std::nullopt;
  if (!status) return unreadable(errno, language);
  if (status->kind == FileStatus::Kind::Folder) return Problem{std::string(kIsDirectory.in(language))};
  const auto size = static_cast<std::size_t>(status->size);
  const bool is_mapped = status->kind == FileStatus::Kind::Regular && size > max_read_bytes;
  return is_mapped ? map(path, file.number(), size, language) : read(file.number(), size, language);
}

std::variant<SourceFile, SourceFile::Problem> SourceFile::map(const std::filesystem::path& path, int descriptor,
                                                              std::size_t size, Language language) {
  SourceFile file;
  file.mapped_ = std::make_unique<MappedFile>(path, descriptor, size, language);
  const int error = file.mapped_->error();
  // Files that the kernel generates on reading (sysfs) have a size but cannot be mapped.
  if (error == ENODEV) return read(descriptor, size, language);
  if (error != 0) return unreadable(error, language);
  if (const std::optional<Text> text = obstacle_in_head(file.text())) return Problem{std::string(text->in(language))};
  std::variant<SourceFile, Problem> result = with_short_lines(std::move(file), language);
  // After the check, which may read backward through a long line.
  if (const auto* const good = std::get_if<SourceFile>(&result)) good->mapped_->will_be_read_in_order();
  return result;
}

std::variant<SourceFile, SourceFile::Problem> SourceFile::read_stream(int descriptor, Language language) {
  const std::optional<FileStatus> status = status_of(descriptor);
  const bool has_size = status && status->kind == FileStatus::Kind::Regular;
  return read(descriptor, has_size ? static_cast<std::size_t>(status->size) : 0, language);
}

std::variant<SourceFile, SourceFile::Problem> SourceFile::of_bytes(std::string_view bytes, Language language) {
  SourceFile file;
  if (!grow(file.read_, bytes.size())) return unreadable(ENOMEM, language);
  bytes.copy(file.read_.data.get(), bytes.size());
  file.read_.size = bytes.size();
  if (const std::optional<Text> text = obstacle_in_head(file.text())) return Problem{std::string(text->in(language))};
  return with_short_lines(std::move(file), language);
}

/// Checks the first bytes before reading further, since a device may have no end.
std::variant<SourceFile, SourceFile::Problem> SourceFile::read(int descriptor, std::size_t expected,
                                                               Language language) {
  static constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();
  SourceFile file;
  if (const int error = read_up_to(kHeadBytes, 0, descriptor, file.read_)) return unreadable(error, language);
  if (const std::optional<Text> text = obstacle_in_head(file.text())) return Problem{std::string(text->in(language))};
  if (const int error = read_up_to(kAll, expected, descriptor, file.read_)) return unreadable(error, language);
  return with_short_lines(std::move(file), language);
}

std::variant<SourceFile, SourceFile::Problem> SourceFile::with_short_lines(SourceFile file, Language language) {
  if (has_line_longer_than(kLongestLine, file.text())) return Problem{std::string(kHasEndlessLine.in(language))};
  return file;
}

std::string_view SourceFile::bytes() const {
  return mapped_ ? mapped_->bytes() : std::string_view(read_.data.get(), read_.size);
}

std::string_view SourceFile::text() const {
  const std::string_view all = bytes();
  return all.starts_with(kByteOrderMark) ? all.substr(kByteOrderMark.size()) : all;
}

std::variant<std::string, FileBytesProblem> read_bytes(const std::filesystem::path& path, std::size_t limit,
                                                       dialect::Language language) {
  using Kind = FileBytesProblem::Kind;
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
