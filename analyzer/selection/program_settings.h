#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "analyzer/rules/check_setup.h"
#include "analyzer/selection/selection.h"
#include "interpreter/configuration/configurations.h"

namespace isocnc::selection {

/// The settings with which one program is checked.
struct ProgramSettings {
  rules::CheckSetup setup;
  Selection selection;
  const configuration::Configuration& configuration;  ///< With the machine and the setups, for a run.
};

/// Finds the settings of programs: those of their configurations, overridden by the command line. The results are valid
/// as long as this object and the configurations are. `of` may be called by several threads at the same time.
class SettingsFinder {
 public:
  /// Errors in the options must have been reported before.
  SettingsFinder(configuration::Configurations& configurations, SelectionOptions command_line)
      : configurations_(configurations), command_line_(std::move(command_line)) {}

  const ProgramSettings& of(const std::filesystem::path& program);

 private:
  /// The configuration, and which of its overrides for some files apply.
  using SettingsKey = std::pair<const configuration::Configuration*, std::vector<bool>>;

  configuration::Configurations& configurations_;
  const SelectionOptions command_line_;
  std::mutex mutex_;  // Of the member below.
  std::map<SettingsKey, std::unique_ptr<const ProgramSettings>> settings_;
};

}  // namespace isocnc::selection
