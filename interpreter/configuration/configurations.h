#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "interpreter/configuration/configuration.h"
#include "interpreter/configuration/mistake.h"

namespace isocnc::configuration {

/// What a configuration file is called, so that it is found.
inline constexpr std::string_view kFileName = "isocnc.json";

/// Which configuration a command wants.
struct Source {
  std::optional<std::string> file;  ///< This one for all programs; else the nearest above each program.
  bool none = false;                ///< None at all.
};

/// The configurations of programs. Each file is read once, and each folder looked into once.
class Configurations {
 public:
  /// `language` is for what the system says of files.
  Configurations(Source source, dialect::Language language);
  Configurations(const Configurations&) = delete;
  Configurations& operator=(const Configurations&) = delete;

  /// The one in force in a folder, which need not exist. Valid as long as this is.
  const Configuration& in_folder(const std::filesystem::path& folder);
  /// The one in force for a program, or, for a folder, in it.
  const Configuration& of(const std::filesystem::path& path);

  /// What is wrong with the files read so far, a line each: `isocnc.json:12:7: error: machine.home.x: ...`.
  std::vector<std::string> mistakes(dialect::Language language) const;

 private:
  struct File {
    Configuration configuration;
    std::vector<std::pair<LineColumn, Mistake>> mistakes;
    std::string problem;  // Why it could not be read.
  };

  const Configuration& nearest(const std::filesystem::path& folder);
  const Configuration& load(const std::filesystem::path& file, const std::filesystem::path& shown);

  const Source source_;
  const dialect::Language language_;
  const Configuration none_;
  std::vector<std::unique_ptr<File>> files_;
  std::unordered_map<std::string, const Configuration*> folders_;  // By their real paths.
  std::unordered_map<std::string, const Configuration*> asked_;    // As they were asked for.
};

/// A path without symlinks, `.` and `..`, of whatever there is of it.
std::filesystem::path real_path(const std::filesystem::path& path);

}  // namespace isocnc::configuration
