#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "interpreter/system/glob.h"

namespace isocnc::configuration {

/// Patterns of paths as gitignore(5) has them, from a folder: one without a slash names files and folders wherever they
/// are, one with a slash inside is a path from the folder, and one with a slash at its end names folders alone. What
/// lies in a folder that is named is named, too.
class PathPatterns {
 public:
  PathPatterns() = default;
  /// The folder is absolute and without symlinks. Patterns must be well-formed.
  PathPatterns(std::filesystem::path folder, const std::vector<std::string>& patterns);

  static bool is_well_formed(std::string_view pattern);

  /// Whether a pattern names the path itself. `path` as the folder: absolute. Outside of the folder only patterns
  /// without a slash name anything.
  bool name(const std::filesystem::path& path, bool is_directory) const;
  /// Whether a pattern names the file, or a folder that it lies in.
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
