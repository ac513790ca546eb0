#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "interpreter/dialect/diagnostic.h"

namespace isocnc::running {

/// A descriptor that text goes to, in large pieces. After the first write that fails nothing more is written, and the
/// reason is kept: who writes a lot asks for it once, at the end.
class OutputFile {
 public:
  /// Writes to `descriptor`, and leaves it open: standard output.
  explicit OutputFile(int descriptor) : descriptor_(descriptor) {}
  /// Makes the file, or empties it; error() tells when that failed.
  explicit OutputFile(const std::filesystem::path& path);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();

  void write(std::string_view text);
  /// Writes what has been gathered, and returns error(). What is not flushed is lost.
  int flush();
  /// The same, and sees to it that what has been written is on the disk: of files.
  int sync();
  /// 0, or the errno of what failed first.
  int error() const { return error_; }

 private:
  static constexpr std::size_t kLarge = 64 * 1024;

  int descriptor_ = -1;
  bool is_ours_ = false;
  int error_ = 0;
  std::string gathered_;
};

/// Flushes an output. When anything written to it has been lost, what to tell: `trace.jsonl: cannot write: ...`.
std::optional<std::string> flush(OutputFile& output, std::string_view name, dialect::Language language);

}  // namespace isocnc::running
