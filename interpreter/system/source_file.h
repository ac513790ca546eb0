#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <variant>

#include "interpreter/dialect/diagnostic.h"
#include "interpreter/system/mapped_file.h"

namespace isocnc::system {

/// The bytes of a program: read to the end, or mapped if the file has more than 8 MiB. Never UTF-16 and never binary;
/// the length of each line fits in 32 bits.
class SourceFile {
 public:
  /// The reason for which a file is refused, as text for a user: `cannot read: Permission denied`. Does not name the
  /// file.
  struct Problem {
    std::string message;
    bool is_in_use = false;  ///< Whether another program keeps the file to itself, for a while as a rule.
  };

  /// If another program cuts a mapped file short while it is in use, its bytes are lost and the program ends
  /// (report_lost_bytes).
  static std::variant<SourceFile, Problem> open(const std::filesystem::path& path, dialect::Language language);
  /// Reads the file without mapping: for servers, which keep running when the file changes.
  static std::variant<SourceFile, Problem> open_unmapped(const std::filesystem::path& path, dialect::Language language);
  /// Reads from the current position of `descriptor` without closing it: for standard input and pipes.
  static std::variant<SourceFile, Problem> read_stream(int descriptor, dialect::Language language);
  /// Takes the bytes of a file that is in no folder, such as a revision in git.
  static std::variant<SourceFile, Problem> of_bytes(std::string_view bytes, dialect::Language language);

  /// The text without a byte-order mark (D5). Valid until this object is moved or destroyed.
  std::string_view text() const;
  bool has_byte_order_mark() const { return text().size() != bytes().size(); }

  /// Bytes of a stream, in memory that is not filled before they are read.
  struct ReadBytes {
    std::unique_ptr<char[]> data;
    std::size_t size = 0;
  };

 private:
  SourceFile() = default;
  static std::variant<SourceFile, Problem> open(const std::filesystem::path& path, std::size_t max_read_bytes,
                                                dialect::Language language);
  static std::variant<SourceFile, Problem> read(int descriptor, std::size_t expected, dialect::Language language);
  static std::variant<SourceFile, Problem> map(const std::filesystem::path& path, int descriptor, std::size_t size,
                                               dialect::Language language);
  static std::variant<SourceFile, Problem> with_short_lines(SourceFile file, dialect::Language language);

  std::string_view bytes() const;

  std::unique_ptr<const MappedFile> mapped_;
  ReadBytes read_;  // The bytes if the file is not mapped.
};

/// Why a file has no bytes for its reader.
struct FileBytesProblem {
  enum class Kind : std::uint8_t {
    Unreadable,  ///< The system refuses, as `message` says.
    NotRegular,  ///< A folder, a pipe, a device.
    TooLarge,    ///< More bytes than wanted.
  };

  Kind kind = Kind::Unreadable;
  std::string message;  ///< `cannot read: Permission denied`; empty for the other kinds.
};

/// Reads a regular file of any content, of at most `limit` bytes. Never waits for a pipe, and reads no device.
std::variant<std::string, FileBytesProblem> read_bytes(const std::filesystem::path& path, std::size_t limit,
                                                       dialect::Language language);

/// A UTF-8 byte-order mark, for writing it back.
inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// Whether a line has more than `limit` bytes without its end. For short lines it reads about one byte in `limit`.
/// Public for tests, which try it with short limits.
bool has_line_longer_than(std::size_t limit, std::string_view text);

}  // namespace isocnc::system
