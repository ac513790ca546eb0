#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace isocnc::threads {

/// Threads that stay: one does tasks while their caller goes on, and whoever has nothing to do helps with them. An
/// exception that leaves a task or its work terminates the program.
class Crew {
 public:
  /// `size` threads with the caller's (fewer if the system gives no more).
  explicit Crew(int size);
  ~Crew();
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  /// Whether there are other threads than the caller's.
  bool has_helpers() const { return !helpers_.empty(); }

  /// Has another thread do a task, after those that were given before. Helps with what they do together where many
  /// tasks wait, and returns once few enough do. Without helpers, does it at once.
  void start(std::function<void()> task);
  /// Returns when all tasks have ended, and helps with their work until then.
  void wait();

  /// Runs `work` on this thread, and on those that have nothing to do before it ends; returns when all have ended. To
  /// be called by a task, or while none runs.
  void together(const std::function<void()>& work);

 private:
  /// Work that others may join; each joins it once.
  struct OpenWork {
    const std::function<void()>* work = nullptr;
    std::uint64_t number = 0;
    int joined = 0;
  };

  void help();
  void help_while(std::unique_lock<std::mutex>& lock, const std::function<bool()>& waits);
  bool is_open_to(std::uint64_t last_joined) const { return open_.work && open_.number != last_joined; }
  void join_work(std::unique_lock<std::mutex>& lock, std::uint64_t& last_joined);

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> tasks_;  ///< That nobody has begun.
  bool is_running_ = false;                  ///< A task has begun and has not ended.
  bool ends_ = false;
  OpenWork open_;
  std::uint64_t last_joined_ = 0;  ///< By the caller's thread.
  std::vector<std::thread> helpers_;
};

}  // namespace isocnc::threads
