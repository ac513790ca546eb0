#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>

namespace isocnc::command_line {

/// A bar on the terminal, from half a second on, drawn ten times a second at most. For any number of threads.
class Progress {
 public:
  using Clock = std::chrono::steady_clock;

  /// `write` puts text on the terminal; without it nothing is shown.
  Progress(std::function<void(std::string_view)> write, std::uint64_t total_bytes,
           std::function<Clock::time_point()> now = Clock::now);
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// So many bytes more have been checked.
  void add(std::uint64_t bytes);
  /// Takes the bar away, before anything else is written.
  void clear();

 private:
  std::string bar(std::uint64_t done) const;

  const std::function<void(std::string_view)> write_;
  const std::function<Clock::time_point()> now_;
  const std::uint64_t total_;
  std::atomic<std::uint64_t> done_ = 0;
  std::mutex mutex_;
  Clock::time_point next_;  // With all below: guarded by mutex_.
  bool is_drawn_ = false;
};

/// Writes to standard error where that is a terminal that can erase a line; else nothing.
std::function<void(std::string_view)> terminal_writer();

}  // namespace isocnc::command_line
