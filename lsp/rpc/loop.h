#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <mutex>

namespace isocnc::lsp::rpc {

/// One thread's work: tasks that any thread may leave, done one after another in the order in which they came. Tasks
/// are to be short, and never to wait: who has more to do does it elsewhere and leaves a task with what has come of it.
class Loop {
 public:
  using Task = std::function<void()>;

  void post(Task task);
  /// Not before that time.
  void post_at(std::chrono::steady_clock::time_point time, Task task);
  /// Does tasks until stop() has been called in one of them. Where none comes for so long, `idle` is called.
  void run(std::chrono::milliseconds idle_after, const Task& idle);
  void stop() { stopped_ = true; }

 private:
  void take_due(std::chrono::steady_clock::time_point now);

  std::mutex mutex_;
  std::condition_variable task_added_;
  std::deque<Task> tasks_;
  std::multimap<std::chrono::steady_clock::time_point, Task> later_;
  bool stopped_ = false;  // Of the loop's thread.
};

}  // namespace isocnc::lsp::rpc
