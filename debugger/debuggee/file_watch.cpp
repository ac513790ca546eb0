#include "debugger/debuggee/file_watch.h"

#include <utility>

namespace isocnc::debuggee {

static constexpr auto kBetweenLooks = std::chrono::milliseconds(1000);

FileWatch::FileWatch(std::filesystem::path file) : file_(std::move(file)), status_(system::status_of(file_)) {}

std::optional<FileWatch::FileChange> FileWatch::find_change() {
  if (has_changed_) return std::nullopt;
  const std::optional<system::FileStatus> now = system::status_of(file_);
  if (now && status_ && now->is_unchanged_since(*status_)) return std::nullopt;
  has_changed_ = true;
  return now ? FileChange::Modified : FileChange::Removed;
}

std::optional<FileWatch::FileChange> FileWatch::find_change_now_and_then() {
  if (has_changed_ || Clock::now() - last_look_ < kBetweenLooks) return std::nullopt;
  last_look_ = Clock::now();
  return find_change();
}

}  // namespace isocnc::debuggee
