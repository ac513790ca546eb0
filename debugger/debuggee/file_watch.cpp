#include "debugger/debuggee/file_watch.h"

#include <utility>

namespace isocnc::debuggee {

static constexpr auto kBetweenLooks = std::chrono::milliseconds(1000);

FileWatch::FileWatch(std::filesystem::path file) : file_(std::move(file)) {
  std::error_code error;
  const auto time = std::filesystem::last_write_time(file_, error);
  if (!error) time_ = time;
}

std::optional<FileWatch::FileChange> FileWatch::find_change() {
  if (has_changed_) return std::nullopt;
  std::error_code error;
  const auto time = std::filesystem::last_write_time(file_, error);
  if (!error && time_ && time == *time_) return std::nullopt;
  has_changed_ = true;
  return error ? FileChange::Removed : FileChange::Modified;
}

std::optional<FileWatch::FileChange> FileWatch::find_change_now_and_then() {
  if (has_changed_ || Clock::now() - last_look_ < kBetweenLooks) return std::nullopt;
  last_look_ = Clock::now();
  return find_change();
}

}  // namespace isocnc::debuggee
