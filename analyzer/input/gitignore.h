#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

namespace isocnc::input {

/// The rules of gitignore(5) in force in one directory. A small value: entering a directory gives a new one, and this
/// one stays valid for the directory's siblings. It does not know the index, so a tracked file that a rule names counts
/// as ignored; nor does it know the user's core.excludesFile.
///
/// Directories and paths are absolute, without symlinks, `.` or `..`.
class GitIgnore {
 public:
  /// No rules, as outside of work trees.
  GitIgnore() = default;
  /// The rules in force in `directory`: .git/info/exclude of its work tree, then every .gitignore from the root of the
  /// work tree down to it. None outside of work trees.
  static GitIgnore at(const std::filesystem::path& directory);
  /// The rules in force in `directory`, a child of the directory of these rules. At the root of another work tree these
  /// rules end.
  GitIgnore entering(const std::filesystem::path& directory) const;
  /// These rules and, with precedence, those in the text of a .gitignore file in `directory`.
  GitIgnore with(std::string_view text, const std::filesystem::path& directory) const;

  /// Whether `path` itself is ignored. Files in an ignored directory need no test, as a search does not enter it.
  bool ignores(const std::filesystem::path& path, bool is_directory) const;

 private:
  struct IgnoreRules;

  std::shared_ptr<const IgnoreRules> innermost_;  // Null outside of work trees.
};

}  // namespace isocnc::input
