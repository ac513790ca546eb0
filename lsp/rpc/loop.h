#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <optional>

#include "lsp/rpc/task.h"

namespace isocnc::rpc {

/// An event loop: runs tasks on one thread, one after another in the order in which they were posted by any thread. A
/// task must be short and must never wait: longer work is done on another thread, which posts a task with the result.
class Loop {
 public:
  void post(Task task);
  /// Runs the task at that time or later.
  void post_at(std::chrono::steady_clock::time_point time, Task task);
  /// Runs tasks until one of them calls stop(). When no task has arrived for `idle_after`, calls `idle`.
  void run(std::chrono::milliseconds idle_after, const Task& idle);
  /// Runs the tasks that are due, until `end`; then those that are left wait for the next call. Returns when the next
  /// task is due, nothing if none waits.
  std::optional<std::chrono::steady_clock::time_point> run_due(std::chrono::steady_clock::time_point end);
  void stop() { stopped_ = true; }
  /// Used on the loop's thread only.
  bool is_stopped() const { return stopped_; }

 private:
  void take_due(std::chrono::steady_clock::time_point now);

  std::mutex mutex_;
  std::condition_variable task_added_;
  std::deque<Task> tasks_;
  std::multimap<std::chrono::steady_clock::time_point, Task> later_;
  bool stopped_ = false;  // Used on the loop's thread only.
};

}  // namespace isocnc::rpc
