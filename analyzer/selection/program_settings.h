#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "analyzer/selection/selection.h"
#include "interpreter/configuration/configurations.h"
#include "interpreter/execution/setup.h"

namespace isocnc::selection {

/// How one program is checked.
struct ProgramSettings {
  execution::Setup setup;
  Selection selection;
};

/// Finds the settings of programs: what their configurations say, and the command line, which outweighs them. They are
/// valid as long as this and the configurations are.
class SettingsFinder {
 public:
  /// What is wrong with the wishes must have been told before.
  SettingsFinder(configuration::Configurations& configurations, SelectionOptions command_line)
      : configurations_(configurations), command_line_(std::move(command_line)) {}

  const ProgramSettings& of(const std::filesystem::path& program);

 private:
  /// The configuration, and which of its wishes for some files hold.
  using Key = std::pair<const configuration::Configuration*, std::vector<bool>>;

  configuration::Configurations& configurations_;
  const SelectionOptions command_line_;
  std::map<Key, std::unique_ptr<const ProgramSettings>> settings_;
};

}  // namespace isocnc::selection
