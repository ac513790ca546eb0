#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <unordered_map>
#include <vector>

#include "interpreter/configuration/configuration.h"
#include "interpreter/configuration/mistake.h"

namespace isocnc::configuration {

/// File name of a configuration.
inline constexpr std::string_view kFileName = "isocnc.json";

/// The choice of configuration by a command.
struct ConfigurationSource {
  std::optional<std::string> file;  ///< The file for all programs; without it, the nearest one above each program.
  bool none = false;                ///< Use no configuration.
};

/// The configurations of programs. Each file is read once, and each folder is searched once. All functions may be
/// called by several threads at the same time: a caller waits for the files that it needs, and for no others.
class Configurations {
 public:
  /// `language` is the language of system errors about files.
  Configurations(ConfigurationSource source, dialect::Language language);
  Configurations(const Configurations&) = delete;
  Configurations& operator=(const Configurations&) = delete;

  /// The configuration for a folder, which need not exist. Valid as long as this object.
  const Configuration& in_folder(const std::filesystem::path& folder);
  /// The configuration for a program or a folder.
  const Configuration& of(const std::filesystem::path& path);

  /// Mistakes in the files read so far, one line each: `isocnc.json:12:7: error: machine.home.x: ...`.
  std::vector<std::string> mistakes(dialect::Language language) const;

 private:
  using ByPath = std::unordered_map<std::string, const Configuration*>;

  struct File {
    std::mutex mutex;  // Of the other members, which do not change once they are read.
    bool is_read = false;
    Configuration configuration;
    std::vector<std::pair<LineColumn, Mistake>> mistakes;
    std::string problem;  // The reason why the file could not be read.
  };

  const Configuration* find(const ByPath& known, const std::filesystem::path& path) const;
  const Configuration& keep(ByPath& known, const std::filesystem::path& path, const Configuration& found);
  const Configuration& nearest(const std::filesystem::path& folder);
  const Configuration& note_unreachable(const std::filesystem::path& file, const std::error_code& error);
  const Configuration& load(const std::filesystem::path& file, const std::filesystem::path& shown);
  File& file_of(const std::filesystem::path& file);
  void read(const std::filesystem::path& file, const std::filesystem::path& shown, File& loaded) const;

  const ConfigurationSource source_;
  const dialect::Language language_;
  const Configuration none_;
  mutable std::mutex mutex_;                           // Of the members below. No file is read under it.
  std::vector<std::unique_ptr<File>> files_;           // In the order in which they were found.
  std::unordered_map<std::string, File*> file_named_;  // Keyed by their paths.
  ByPath folders_;                                     // Keyed by the real paths of folders.
  ByPath asked_;                                       // Keyed by the paths of the queries.
};

/// The path without symlinks, `.` and `..`, as far as it exists.
std::filesystem::path real_path(const std::filesystem::path& path);

}  // namespace isocnc::configuration
