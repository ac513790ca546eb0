#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "interpreter/dialect/diagnostic.h"

namespace isocnc::analyzer {

/// What programs are called, unless the configuration says otherwise.
inline const std::array<std::string, 5> kProgramExtensions{".iso", ".nc", ".cnc", ".tap", ".ngc"};

/// The programs that are to be checked, and what stood in the way of finding them.
struct FileSelection {
  std::vector<std::filesystem::path> files;  ///< As the user would write them: relative stays relative.
  std::vector<std::string> problems;         ///< Paths that do not exist and directories that cannot be read.
  bool is_refused = false;                   ///< The problem is with the command: there is nothing to go on with.
};

/// The programs that `paths` name: files as they are, whatever they are called, and directories searched for names that
/// end in one of `extensions` (with their dot; upper and lower case are the same). In the order given, what a directory
/// holds sorted by path, byte by byte; each file once, under the first of its names.
///
/// In git's work trees a search passes over what git would ignore; a directory that is named is searched all the same.
/// Nowhere does it enter `.git` and other directories whose names begin like that, or symlinks to directories. Symlinks
/// to files are files.
FileSelection select_files(std::span<const std::string> paths, std::span<const std::string> extensions,
                           dialect::Language language);

/// What a command's paths name: as above, but `-` alone is standard input, and where directories hold no program that
/// is refused.
FileSelection select_programs(std::span<const std::string> paths, dialect::Language language);

}  // namespace isocnc::analyzer
