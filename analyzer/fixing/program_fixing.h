#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "analyzer/fixing/fixer.h"
#include "interpreter/system/replace_file.h"
#include "interpreter/system/source_file.h"

namespace isocnc::fixing {

/// A file that is to be fixed in place. Begin before the file is read: what somebody else changes meanwhile is left to
/// them.
class FileFixing {
 public:
  explicit FileFixing(const std::filesystem::path& path) : replacement_(path) {}

  /// Puts the fixed text in the file's place, where it is another one. Returns what stood in the way; the file is then
  /// as it was.
  std::optional<std::string> finish(const system::SourceFile& source, const FixedText& fixed,
                                    dialect::Language language);

 private:
  system::FileReplacement replacement_;
};

/// Writes the fixed program, with its byte-order mark.
void write_fixed(const system::SourceFile& source, const FixedText& fixed,
                 const std::function<void(std::string_view)>& write);

/// Writes what the fixes change as a unified diff; false when they change nothing.
bool write_diff(const std::string& name, const system::SourceFile& source, const FixedText& fixed,
                std::function<void(std::string_view)> write);

}  // namespace isocnc::fixing
