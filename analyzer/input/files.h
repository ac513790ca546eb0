#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "interpreter/configuration/configurations.h"
#include "interpreter/dialect/diagnostic.h"

namespace isocnc::input {

using configuration::kProgramExtensions;

/// Which files of a folder a search accepts.
struct SearchRules {
  std::span<const std::string> extensions;                ///< The extensions, with their dot; case does not matter.
  const configuration::PathPatterns* excluded = nullptr;  ///< Files and folders to skip.
};
/// The rules of a folder; its path must have no symlinks.
using RulesOfFolder = std::function<SearchRules(const std::filesystem::path& folder)>;

/// The programs to check, and problems in finding them.
struct FileSelection {
  std::vector<std::filesystem::path> files;  ///< The files as a user would write them: relative paths stay relative.
  std::vector<std::string> problems;         ///< Paths that do not exist and directories that cannot be read.
  bool is_refused = false;                   ///< Whether the command is wrong, so that it must stop.
};

/// The programs that `paths` name: files, whatever their names, and directories, searched for names that the rules
/// accept. In the given order, the files of a directory sorted by path, byte by byte; each file once, under its first
/// name.
///
/// In git work trees a search skips what git ignores, but a directory named in `paths` is always searched. The search
/// never enters `.git` and other directories whose names start like that, and never follows a symlink.
FileSelection select_files(std::span<const std::string> paths, const RulesOfFolder& rules, dialect::Language language);
/// The same, with the same extensions everywhere.
FileSelection select_files(std::span<const std::string> paths, std::span<const std::string> extensions,
                           dialect::Language language);

/// The programs that a command's paths name, according to the configuration of each folder: as above, but `-` alone is
/// standard input, and finding no program at all is an error of the command.
FileSelection select_programs(std::span<const std::string> paths, configuration::Configurations& configurations,
                              dialect::Language language);

/// The path at which the configuration of a program is looked up: standard input has the name given in the command.
std::filesystem::path place_of_program(const std::filesystem::path& path, const std::string& stdin_name);

/// The total size of the files, in bytes. Files of unknown size, such as standard input, count as 0.
std::uint64_t bytes_of(const std::vector<std::filesystem::path>& files);

}  // namespace isocnc::input
