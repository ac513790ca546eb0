#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace isocnc::check {

/// Runs `work` on this thread and on `workers` - 1 others (fewer if the system gives no more), and returns when all
/// have ended. With several threads, an exception that leaves `work` terminates the program: the others may be waiting
/// for the work that failed.
void side_by_side(int workers, const std::function<void()>& work);

/// The number of processors, at least 1.
int processor_count();
/// The same on all processors.
void on_all_processors(const std::function<void()>& work);

/// Threads that stay: one does a task while its caller goes on, and whoever has nothing to do helps with it. An
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

  /// Has another thread do a task; waits for the last one before. Without helpers, does it at once.
  void start(std::function<void()> task);
  /// Returns when the task has ended, and helps with its work until then.
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
  void join_work(std::unique_lock<std::mutex>& lock, std::uint64_t& last_joined);

  std::mutex mutex_;
  std::condition_variable changed_;
  std::function<void()> task_;  ///< That nobody has begun.
  bool is_running_ = false;     ///< A task has been given and has not ended.
  bool ends_ = false;
  OpenWork open_;
  std::vector<std::thread> helpers_;
};

}  // namespace isocnc::check
