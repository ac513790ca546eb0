#include "lsp/documents/settings_store.h"

#include <set>

#include "interpreter/system/user_language.h"

namespace isocnc::documents {

/// The configuration files read since the last forget().
struct SettingsStore::Generation {
  configuration::Configurations found{{}, system::user_language()};
  configuration::Configurations none{{.file = {}, .none = true}, system::user_language()};
  selection::SettingsFinder settings{found, {}};
  selection::SettingsFinder settings_of_none{none, {}};
  configuration::Scenes scenes{system::user_language()};
  std::mutex mutex;  // Of the member below. The others have their own.
  std::set<std::filesystem::path> claimed;
};

SettingsStore::SettingsStore() : generation_(std::make_shared<Generation>()) {}

std::shared_ptr<SettingsStore::Generation> SettingsStore::present() {
  const std::lock_guard lock(mutex_);
  return generation_;
}

bool SettingsStore::claim(const std::filesystem::path& file) {
  const auto generation = present();
  const std::lock_guard lock(generation->mutex);
  return generation->claimed.insert(file).second;
}

DocumentSettings SettingsStore::of(const std::optional<std::filesystem::path>& program) {
  const auto generation = present();
  if (!program)
    return {generation, &generation->settings_of_none.of({}), &generation->none.in_folder({}), &generation->scenes, {}};
  return {generation, &generation->settings.of(*program), &generation->found.in_folder(program->parent_path()),
          &generation->scenes, *program};
}

void SettingsStore::forget() {
  const std::lock_guard lock(mutex_);
  generation_ = std::make_shared<Generation>();
}

}  // namespace isocnc::documents
