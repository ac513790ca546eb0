#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "interpreter/dialect/diagnostic.h"
#include "interpreter/system/file_status.h"
#include "interpreter/system/output_file.h"

namespace isocnc::system {

/// Replaces the text of a program, completely or not at all, like an OutputFile with a name but with additional checks.
/// Text that is not committed is discarded.
///
/// Construct it before the file is read: a file that another program changes after that is left unchanged.
class FileReplacement {
 public:
  /// Inspects the file, following symlinks, without changing it.
  explicit FileReplacement(const std::filesystem::path& path);
  FileReplacement(const FileReplacement&) = delete;
  FileReplacement& operator=(const FileReplacement&) = delete;

  /// Appends to the new text. commit() reports errors.
  void write(std::string_view text);
  /// Replaces the file by the new text, keeping its mode and, if permitted, its owner. If this fails, returns the
  /// reason and leaves the file unchanged.
  std::optional<std::string> commit(dialect::Language language);

 private:
  std::string why_not(dialect::Language language) const;
  const dialect::Text* change_meanwhile() const;

  std::filesystem::path target_;  // Path without symlinks.
  FileStatus status_;
  int error_ = 0;
  const dialect::Text* refusal_ = nullptr;
  std::optional<OutputFile> output_;  // Open after the first write().
};

}  // namespace isocnc::system
