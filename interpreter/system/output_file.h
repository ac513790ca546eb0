#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "interpreter/dialect/diagnostic.h"
#include "interpreter/system/descriptor.h"
#include "interpreter/system/file_status.h"
#include "interpreter/system/temporary_file.h"

namespace isocnc::system {

/// Writes text to a descriptor in large pieces. After the first failed write nothing more is written and the reason is
/// kept, so that the caller can check it once, at the end.
class OutputFile {
 public:
  /// Writes to `descriptor` without closing it: for standard output.
  explicit OutputFile(int descriptor) : descriptor_(descriptor) {}
  /// Writes to a temporary file that commit() renames over the target, keeping its mode and, if permitted, its owner.
  /// Readers see the old or the new file, never a mixture, even after a power cut. Follows symlinks; the target need
  /// not exist. Devices, pipes and files open already (/dev/stdout) are written in place. Check error() after
  /// construction. Without commit() the text is discarded, and the target stays unchanged.
  explicit OutputFile(const std::filesystem::path& path);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view text);
  /// Writes the buffered text and returns error(). Text that is not flushed is lost.
  int flush();
  /// Flushes, and for a file with a name waits until the text is on the disk; returns error().
  int sync();
  /// Like sync(), then renames the file over the target; returns error(). Call it once.
  int commit();
  /// 0, or the errno of the first failure.
  int error() const { return error_; }

 private:
  void open_in_place(const std::filesystem::path& path);
  void open_beside();

  static constexpr std::size_t kLarge = 64 * 1024;

  int descriptor_ = -1;
  int error_ = 0;
  std::string gathered_;
  std::filesystem::path target_;            // Path without symlinks.
  std::optional<FileStatus> status_;        // Status of the existing target.
  std::optional<TemporaryFile> temporary_;  // File that commit() renames over the target.
  Descriptor file_;                         // Of a file with a name. Closed before the temporary file is removed.
};

/// Commits an output. If any text has been lost, returns the message: `trace.jsonl: cannot write: ...`.
std::optional<std::string> commit(OutputFile& output, std::string_view name, dialect::Language language);

}  // namespace isocnc::system
