#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/system/glob.h"

namespace isocnc::configuration {

/// Path patterns as in gitignore(5), relative to a folder. A pattern without a slash matches files and folders at any
/// depth, one with a slash inside matches a path from the folder, and one with a slash at its end matches folders only.
/// The content of a matched folder is matched, too. Latin letters match in upper and lower case.
class PathPatterns {
 public:
  PathPatterns() = default;
  /// `folder` is absolute and without symlinks. Patterns must be well-formed.
  PathPatterns(std::filesystem::path folder, const std::vector<std::string>& patterns);

  static bool is_well_formed(std::string_view pattern);

  /// Whether a pattern matches the path itself. `path` is absolute, like the folder. Outside the folder only patterns
  /// without a slash match.
  bool name(const std::filesystem::path& path, bool is_directory) const;
  /// Whether a pattern matches the file or a folder that contains it.
  bool match(const std::filesystem::path& file) const;

 private:
  struct Pattern {
    system::Glob glob;
    bool only_directories = false;
    bool whole_path = false;
  };

  static std::optional<Pattern> parse(std::string_view text);

  std::filesystem::path folder_;
  std::vector<Pattern> patterns_;
};

}  // namespace isocnc::configuration
