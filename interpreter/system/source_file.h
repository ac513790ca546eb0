#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <variant>

#include "interpreter/dialect/diagnostic.h"
#include "interpreter/system/mapped_file.h"

namespace isocnc::system {

/// A program's bytes: read to the end, or a file of more than 8 MiB mapped. Never UTF-16, never binary, and no line of
/// it is longer than 32 bits can count.
class SourceFile {
 public:
  /// Why a file cannot be taken, for people: `cannot read: Permission denied`. Does not name the file.
  struct Problem {
    std::string message;
  };

  /// Who cuts a mapped file short while it is in use takes its bytes away, which is the end (tell_of_lost_bytes).
  static std::variant<SourceFile, Problem> open(const std::filesystem::path& path, dialect::Language language);
  /// Maps nothing: for servers, which outlive what happens to a file.
  static std::variant<SourceFile, Problem> open_unmapped(const std::filesystem::path& path, dialect::Language language);
  /// Reads on from where `descriptor` stands, and leaves it open: standard input, pipes.
  static std::variant<SourceFile, Problem> read_stream(int descriptor, dialect::Language language);

  /// Without a byte-order mark (D5). Valid as long as this, and not beyond a move.
  std::string_view text() const;
  bool has_byte_order_mark() const { return text().size() != bytes().size(); }

 private:
  SourceFile() = default;
  static std::variant<SourceFile, Problem> open(const std::filesystem::path& path, std::size_t max_read_bytes,
                                                dialect::Language language);
  static std::variant<SourceFile, Problem> read(int descriptor, std::size_t expected, dialect::Language language);
  static std::variant<SourceFile, Problem> map(const std::filesystem::path& path, int descriptor, std::size_t size,
                                               dialect::Language language);
  static std::variant<SourceFile, Problem> checked(SourceFile file, dialect::Language language);

  std::string_view bytes() const;

  std::unique_ptr<const MappedFile> mapped_;
  std::string read_;  // When nothing is mapped.
};

/// A UTF-8 byte-order mark, for who puts it back.
inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// Whether some line has more than `limit` bytes, its end not counted. Looks at one place in `limit` bytes as long as
/// lines are short.
bool has_line_longer_than(std::size_t limit, std::string_view text);

}  // namespace isocnc::system
