#pragma once

#include <sys/stat.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "interpreter/dialect/diagnostic.h"
#include "interpreter/system/output_file.h"

namespace isocnc::system {

/// A new text in the place of a program's old one: all of it or nothing, as any OutputFile that has a name, and with
/// more care. What has been written is thrown away unless it is committed.
///
/// Begin before the file is read: a file that somebody else changes from then on is left to them.
class FileReplacement {
 public:
  /// Looks at the file, through symlinks, and touches nothing.
  explicit FileReplacement(const std::filesystem::path& path);
  FileReplacement(const FileReplacement&) = delete;
  FileReplacement& operator=(const FileReplacement&) = delete;

  /// Appends to the new text. What goes wrong is told by commit().
  void write(std::string_view text);
  /// Puts the new text in the file's place, with the file's mode and, where that is permitted, its owner. Returns what
  /// stood in the way; the file is then as it was.
  std::optional<std::string> commit(dialect::Language language);

 private:
  std::string why_not(dialect::Language language) const;
  bool is_unchanged() const;

  std::filesystem::path target_;  // Without symlinks.
  struct stat status_ {};
  int error_ = 0;
  const dialect::Text* refusal_ = nullptr;
  std::optional<OutputFile> output_;  // Once there is something to write.
};

}  // namespace isocnc::system
