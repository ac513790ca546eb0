#include "analyzer/selection/program_settings.h"

#include <fmt/format.h>

namespace isocnc::selection {

using namespace dialect::literals;
using configuration::CodeSelection;
using configuration::Configuration;
using configuration::FileOverrides;

static SelectionOptions selection_options(const CodeSelection& selection) {
  SelectionOptions result{.select = selection.select, .ignore = selection.ignore, .severities = {}};
  for (const auto& [code, severity] : selection.severity)
    result.severities.push_back(fmt::format("{}={}", code, severity));
  return result;
}

static Selection selection_of(const Configuration& configuration, const std::vector<bool>& holds,
                              const SelectionOptions& command_line) {
  static constexpr auto kLanguage = dialect::Language::English;  // For errors, which have been reported before.
  Selection selection;
  selection.follow(selection_options(configuration.lint.selection), kLanguage);
  for (std::size_t i = 0; i < holds.size(); ++i)
    if (holds[i]) selection.follow(selection_options(configuration.lint.files[i].selection), kLanguage);
  selection.follow(command_line, kLanguage);
  return selection;
}

const ProgramSettings& SettingsFinder::of(const std::filesystem::path& program) {
  const Configuration& configuration = configurations_.in_folder(program.parent_path());
  std::vector<bool> holds;
  if (!configuration.lint.files.empty()) {
    const std::filesystem::path real = configuration::real_path(program.parent_path()) / program.filename();
    for (const FileOverrides& files : configuration.lint.files) holds.push_back(files.patterns.match(real));
  }
  const std::lock_guard lock(mutex_);
  std::unique_ptr<const ProgramSettings>& settings = settings_[{&configuration, holds}];
  if (!settings) {
    const Selection selection = selection_of(configuration, holds, command_line_);
    const bool every_motion = selection.shows("motion-goes-nowhere"_diag);
    const std::vector<dialect::HouseWatch>& watches = configuration.lint.house_watches;
    const bool has_house_rules = !watches.empty() && selection.shows("house-rule"_diag);
    const rules::CheckSetup setup{configuration.machine.setup, configuration.lint.thresholds, every_motion,
                                  has_house_rules ? std::make_shared<const rules::HouseRules>(watches) : nullptr};
    settings = std::make_unique<const ProgramSettings>(ProgramSettings{setup, selection, configuration});
  }
  return *settings;
}

}  // namespace isocnc::selection
