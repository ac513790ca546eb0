#pragma once

#include <optional>
#include <span>
#include <string>

#include "interpreter/dialect/diagnostic.h"

namespace isocnc::git {

/// One version of a file, as git gives it to a program that shows differences.
struct DiffedVersion {
  std::string path;    ///< In the repository, from its top.
  std::string file;    ///< Where its bytes are: the working tree's, or a temporary file. `/dev/null` for none.
  std::string object;  ///< Its name in git; `.` for none.
  std::string mode;    ///< `100644`; `.` for none.

  bool is_there() const { return file != "/dev/null" && file != "nul"; }
  /// Whether it can be a program, not a symbolic link or a submodule.
  bool is_file() const { return mode == "." || mode.starts_with("100"); }
};

/// What git asks a program to show that it calls as GIT_EXTERNAL_DIFF, diff.external or diff.DRIVER.command (gitdiff).
struct ExternalDiff {
  DiffedVersion old_version;
  DiffedVersion new_version;
  bool is_unmerged = false;  ///< In a merge with conflicts; there is but a path.

  /// The names and what changes of them: `old.iso -> new.iso`, `part.iso (new)`.
  std::string heading(dialect::Language language) const;
};

/// Reads the arguments that git gives: a path, and for each version a file, an object and a mode; after these, where
/// the path changes, the new one and what git says of that. Only a path where a merge has left conflicts. None for
/// others.
std::optional<ExternalDiff> read_external_diff(std::span<const std::string> arguments);

/// How many files git has shown before this one.
int diffs_before();

/// Whether git runs the program for files of all kinds, by GIT_EXTERNAL_DIFF.
bool is_for_all_files();

}  // namespace isocnc::git
