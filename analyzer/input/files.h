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

/// Which files of a folder a search takes.
struct SearchRules {
  std::span<const std::string> extensions;                ///< With their point; upper and lower case are the same.
  const configuration::PathPatterns* excluded = nullptr;  ///< Files and folders that are passed over.
};
/// The rules of a folder, which has no symlinks in its path.
using RulesOfFolder = std::function<SearchRules(const std::filesystem::path& folder)>;

/// The programs that are to be checked, and what stood in the way of finding them.
struct FileSelection {
  std::vector<std::filesystem::path> files;  ///< As the user would write them: relative stays relative.
  std::vector<std::string> problems;         ///< Paths that do not exist and directories that cannot be read.
  bool is_refused = false;                   ///< The problem is with the command: there is nothing to go on with.
};

/// The programs that `paths` name: files as they are, whatever they are called, and directories searched for names that
/// the rules take. In the order given, what a directory holds sorted by path, byte by byte; each file once, under the
/// first of its names.
///
/// In git's work trees a search passes over what git would ignore; a directory that is named is searched all the same.
/// Nowhere does it enter `.git` and other directories whose names begin like that, or follow a symlink.
FileSelection select_files(std::span<const std::string> paths, const RulesOfFolder& rules, dialect::Language language);
/// With the same extensions everywhere.
FileSelection select_files(std::span<const std::string> paths, std::span<const std::string> extensions,
                           dialect::Language language);

/// What a command's paths name, by the configuration of each folder: as above, but `-` alone is standard input, and
/// where directories hold no program that is refused.
FileSelection select_programs(std::span<const std::string> paths, configuration::Configurations& configurations,
                              dialect::Language language);

/// Where the configuration of a program is looked for: standard input has the name that it was given.
std::filesystem::path place_of_program(const std::filesystem::path& path, const std::string& stdin_name);

/// How long they are together. Those that cannot be told, as of standard input, count as nothing.
std::uint64_t bytes_of(const std::vector<std::filesystem::path>& files);

}  // namespace isocnc::input
