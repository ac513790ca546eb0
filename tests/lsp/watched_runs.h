#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "lsp/background/verification.h"

namespace isocnc::lsp {

/// The runs of verifications as a test sees and holds them. While they are held, each waits until it is released or
/// stopped.
class WatchedRuns {
 public:
  /// Options whose runs are watched, and wait for no clock: a pause in typing has no length.
  background::VerificationOptions options() {
    background::VerificationOptions options;
    options.pause = std::chrono::milliseconds(0);
    options.slow = std::chrono::hours(1);
    options.run = [this](std::string_view text, const selection::ProgramSettings& settings,
                         const verification::Scene* scene,
                         const selection::VerifyOptions& how) { return run(text, settings, scene, how); };
    return options;
  }

  void hold() {
    const std::lock_guard lock(mutex_);
    is_held_ = true;
  }
  void release() {
    {
      const std::lock_guard lock(mutex_);
      is_held_ = false;
    }
    changed_.notify_all();
  }
  /// Waits until so many runs have started, or been stopped. Returns the texts of those that have started.
  std::vector<std::string> wait_for_starts(std::size_t count) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, kLongest, [&] { return texts_.size() >= count; });
    return texts_;
  }
  bool wait_for_stops(std::size_t count) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, kLongest, [&] { return stopped_ >= count; });
  }
  std::vector<std::string> texts() {
    const std::lock_guard lock(mutex_);
    return texts_;
  }

 private:
  static constexpr std::chrono::seconds kLongest{120};

  verification::VerifiedRun run(std::string_view text, const selection::ProgramSettings& settings,
                                const verification::Scene* scene, const selection::VerifyOptions& how) {
    std::unique_lock lock(mutex_);
    texts_.emplace_back(text);
    changed_.notify_all();
    while (is_held_ && !how.stop()) changed_.wait_for(lock, std::chrono::milliseconds(1));
    if (how.stop()) {
      ++stopped_;
      changed_.notify_all();
    }
    lock.unlock();
    return selection::verified(text, settings, scene, how);
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_held_ = false;
  std::vector<std::string> texts_;
  std::size_t stopped_ = 0;
};

}  // namespace isocnc::lsp
