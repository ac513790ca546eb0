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

bool SettingsStore::claim(const DocumentSettings& settings, const std::filesystem::path& file) {
  const auto generation = present();
  if (settings.owner != generation) return false;
  const std::lock_guard lock(generation->mutex);
  return generation->claimed.insert(file).second;
}

std::unique_lock<std::mutex> SettingsStore::turn_to_report(const DocumentSettings& settings,
                                                           const std::filesystem::path& file) {
  const auto turn_of = [&]() -> std::mutex& {
    const std::lock_guard lock(mutex_);
    return turns_[file];
  };
  std::unique_lock turn(turn_of());
  if (settings.owner != present()) turn.unlock();
  return turn;
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
