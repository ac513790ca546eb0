#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>

#include "interpreter/system/file_status.h"

namespace isocnc::debuggee {

/// Notices that a file has changed since the watch was made. Only the first change counts.
class FileWatch {
 public:
  enum class FileChange : std::uint8_t { Modified, Removed };

  FileWatch() = default;
  explicit FileWatch(std::filesystem::path file);

  /// The first change, the first time that it is found.
  std::optional<FileChange> find_change();
  /// The same, but looks at the file once a second at most.
  std::optional<FileChange> find_change_now_and_then();

 private:
  using Clock = std::chrono::steady_clock;

  std::filesystem::path file_;
  std::optional<system::FileStatus> status_;  ///< None: there was no such file.
  bool has_changed_ = false;
  Clock::time_point last_look_;
};

}  // namespace isocnc::debuggee
