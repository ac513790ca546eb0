#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>

#include "interpreter/dialect/diagnostic.h"

namespace isocnc::git {

/// A file of a revision, as git writes it: `HEAD~2:parts/flange.iso`, `v1.2:./flange.iso`, or `:flange.iso` for what is
/// staged.
struct RevisionFile {
  std::string revision;  ///< `HEAD~2`; empty for what is staged.
  std::string stage;     ///< Of a merge, `0` to `3`, of `:2:flange.iso`; else empty.
  std::string path;  ///< From the top of the repository, or from the current folder if it begins with `./` or `../`.

  /// What git calls another path of the same revision.
  std::string name_of(const std::string& other_path) const;
};

/// The file of a revision that an operand of a command names. None where it names a file of a folder: a file that
/// exists is always meant; `C:x.iso` on Windows, `C:\x.iso` and `C:/x.iso` anywhere are on a drive; and no revision
/// begins with
/// `/` or `.`.
std::optional<RevisionFile> revision_file(const std::string& operand);

/// The text of a file of a revision.
struct FileAtRevision {
  std::string bytes;            ///< As a checkout would write them: with filters and line ends.
  std::filesystem::path place;  ///< Where the working tree has the file, if it has it; as seen from the current folder.
};

/// Asks git for a file. Why it has none, as text for a user that does not name the file.
std::variant<FileAtRevision, std::string> read(const RevisionFile& file, dialect::Language language);

}  // namespace isocnc::git
