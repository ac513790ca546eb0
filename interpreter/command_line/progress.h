#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>

namespace isocnc::command_line {

/// A progress bar on the terminal, shown after half a second and drawn at most ten times a second. Thread-safe.
class Progress {
 public:
  using Clock = std::chrono::steady_clock;

  /// `write` prints text on the terminal; without it nothing is shown.
  Progress(std::function<void(std::string_view)> write, std::uint64_t total_bytes,
           std::function<Clock::time_point()> now = Clock::now);
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Adds a number of checked bytes.
  void add(std::uint64_t bytes);
  /// Erases the bar; call it before other output.
  void clear();

 private:
  std::string bar(std::uint64_t done) const;

  const std::function<void(std::string_view)> write_;
  const std::function<Clock::time_point()> now_;
  const std::uint64_t total_;
  std::atomic<std::uint64_t> done_ = 0;
  std::mutex mutex_;
  Clock::time_point next_;  // Guarded by mutex_, like the members below.
  bool is_drawn_ = false;
};

/// Returns a function that writes to standard error if that is a terminal that can erase a line; otherwise an empty
/// one.
std::function<void(std::string_view)> terminal_writer();

}  // namespace isocnc::command_line
