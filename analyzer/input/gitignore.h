#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

namespace isocnc::input {

/// The rules of gitignore(5) that are in force in one directory. A small value: entering a directory gives another one,
/// and this one still holds for the directory's neighbors. Knows nothing of the index, so that a file which git tracks
/// although a rule names it is ignored here; nor of the user's own core.excludesFile.
///
/// Directories and paths are absolute, without symlinks, `.` or `..`.
class GitIgnore {
 public:
  /// No rules: not in a work tree.
  GitIgnore() = default;
  /// The rules in force in `directory`: .git/info/exclude of its work tree, then every .gitignore from the root of the
  /// work tree down to it. None outside of work trees.
  static GitIgnore at(const std::filesystem::path& directory);
  /// The rules in force in `directory`, which lies in the directory that these rules are in force in. The rules end
  /// where another work tree begins.
  GitIgnore entering(const std::filesystem::path& directory) const;
  /// These rules and, stronger, those in the text of a .gitignore file in `directory`.
  GitIgnore with(std::string_view text, const std::filesystem::path& directory) const;

  /// Asks for `path` alone. What lies in an ignored directory is ignored because nobody enters it to ask.
  bool ignores(const std::filesystem::path& path, bool is_directory) const;

 private:
  struct Rules;

  std::shared_ptr<const Rules> innermost_;  // Null outside of work trees.
};

}  // namespace isocnc::input
