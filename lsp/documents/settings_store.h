#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>

#include "analyzer/selection/program_settings.h"
#include "interpreter/configuration/scenes.h"

namespace isocnc::documents {

/// How a program is checked, with its configuration. Does not change when the files change.
struct DocumentSettings {
  std::shared_ptr<const void> owner;  ///< Keeps the objects alive that the other members point to.
  const selection::ProgramSettings* program = nullptr;
  const configuration::Configuration* configuration = nullptr;
  configuration::Scenes* scenes = nullptr;
  std::filesystem::path file;  ///< Of the program; empty without one.

  /// What surrounds the program; null if nothing is known of it. May read files.
  std::shared_ptr<const verification::Scene> scene() const { return scenes->of(*configuration, file); }
  /// Whether that is because what describes it has a mistake.
  bool has_mistaken_scene() const { return scenes->is_mistaken(*configuration, file); }
};

/// The settings of programs, from the configuration files. Reads each file once, until forget().
class SettingsStore {
 public:
  SettingsStore();

  /// The settings of a program; may read files. A program without a path has no configuration. May be called on any
  /// thread, which waits for no file that the program does not need.
  DocumentSettings of(const std::optional<std::filesystem::path>& program);
  /// Drops what was read, since files may have changed. May be called on any thread.
  void forget();
  /// True for the first call about this configuration file since the last forget(): that caller has to report the
  /// file's findings. False for settings from before it. May be called on any thread.
  bool claim(const DocumentSettings& settings, const std::filesystem::path& file);
  /// A lock to be held while the findings in a configuration file are put together and reported, so that what was put
  /// together later is reported later. Not owned for settings from before the last forget(): others report the file
  /// then. May be called on any thread.
  std::unique_lock<std::mutex> turn_to_report(const DocumentSettings& settings, const std::filesystem::path& file);

 private:
  struct Generation;

  std::shared_ptr<Generation> present();

  std::mutex mutex_;  // Of the members below, but not of the turns in them.
  std::shared_ptr<Generation> generation_;
  std::map<std::filesystem::path, std::mutex> turns_;
};

}  // namespace isocnc::documents
