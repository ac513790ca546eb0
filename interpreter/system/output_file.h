#pragma once

#include <sys/stat.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "interpreter/dialect/diagnostic.h"
#include "interpreter/system/temporary_file.h"

namespace isocnc::system {

/// A descriptor that text goes to, in large pieces. After the first write that fails nothing more is written, and the
/// reason is kept: who writes a lot asks for it once, at the end.
class OutputFile {
 public:
  /// Writes to `descriptor`, and leaves it open: standard output.
  explicit OutputFile(int descriptor) : descriptor_(descriptor) {}
  /// Writes a file, all of it or nothing: a new one beside it, which commit() puts in its place, with its mode and,
  /// where that is permitted, its owner. So whoever opens the file at any moment, also after a power cut, finds what
  /// was there or what is new, whole. Goes through symlinks; there need be no file yet. Devices and pipes, and files
  /// that are open already (/dev/stdout), are written to as they are. error() tells when it cannot begin.
  explicit OutputFile(const std::filesystem::path& path);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  /// What has not been committed is gone; the file is as it was.
  ~OutputFile();

  void write(std::string_view text);
  /// Writes what has been gathered, and returns error(). What is not flushed is lost.
  int flush();
  /// Flushes, and sees to it that all is on the disk, where it has a name; returns error().
  int sync();
  /// The same, and then puts the file in its place; returns error(). To be called once.
  int commit();
  /// 0, or the errno of what failed first.
  int error() const { return error_; }

 private:
  void open_in_place(const std::filesystem::path& path);
  void open_beside();
  bool take_over_attributes() const;

  static constexpr std::size_t kLarge = 64 * 1024;

  int descriptor_ = -1;
  bool owns_descriptor_ = false;
  int error_ = 0;
  std::string gathered_;
  std::filesystem::path target_;            // Without symlinks.
  std::optional<struct stat> status_;       // Of the file that is there.
  std::optional<TemporaryFile> temporary_;  // That is to become the target.
};

/// Commits an output. When anything written to it has been lost, what to tell: `trace.jsonl: cannot write: ...`.
std::optional<std::string> commit(OutputFile& output, std::string_view name, dialect::Language language);

}  // namespace isocnc::system
