#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>

#include "analyzer/selection/program_settings.h"

namespace isocnc::lsp::documents {

/// How a program is checked, with its configuration. Stays as it is when the files change.
struct DocumentSettings {
  std::shared_ptr<const void> owner;  ///< Of what the others refer to.
  const selection::ProgramSettings* program = nullptr;
  const configuration::Configuration* configuration = nullptr;
};

/// The settings of programs by what the configuration files say. Reads each file once, until forget().
class SettingsStore {
 public:
  SettingsStore();

  /// May read files. Programs that lie in no folder have no configuration. Any thread.
  DocumentSettings of(const std::optional<std::filesystem::path>& program);
  /// Files may have changed. Any thread.
  void forget();
  /// Whether nobody has asked so about this configuration file since the last forget(): then it is the caller's to tell
  /// what is wrong with it. Any thread.
  bool claim(const std::filesystem::path& file);

 private:
  struct Generation;

  std::shared_ptr<Generation> present();

  std::mutex mutex_;
  std::shared_ptr<Generation> generation_;
};

}  // namespace isocnc::lsp::documents
