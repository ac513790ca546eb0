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

/// A file to be fixed in place. Construct it before the file is read, so that changes that others make meanwhile are
/// not overwritten.
class FileFixing {
 public:
  explicit FileFixing(const std::filesystem::path& path) : replacement_(path) {}

  /// Replaces the file by the fixed text if that differs. Returns the reason for a failure; the file is then unchanged.
  std::optional<std::string> finish(const system::SourceFile& source, const FixedText& fixed,
                                    dialect::Language language);

 private:
  system::FileReplacement replacement_;
};

/// Writes the fixed program, with its byte-order mark.
void write_fixed(const system::SourceFile& source, const FixedText& fixed,
                 const std::function<void(std::string_view)>& write);

/// Writes the changes of the fixes as a unified diff; false if there are none.
bool write_diff(const std::string& name, const system::SourceFile& source, const FixedText& fixed,
                std::function<void(std::string_view)> write);

}  // namespace isocnc::fixing
