#include "lsp/rpc/loop.h"

#include <algorithm>
#include <utility>

namespace isocnc::rpc {

void Loop::post(Task task) {
  {
    const std::lock_guard lock(mutex_);
    tasks_.push_back(std::move(task));
  }
  task_added_.notify_one();
}

void Loop::post_at(std::chrono::steady_clock::time_point time, Task task) {
  {
    const std::lock_guard lock(mutex_);
    later_.emplace(time, std::move(task));
  }
  task_added_.notify_one();
}

/// Moves the tasks of post_at() that are due to the queue.
void Loop::take_due(std::chrono::steady_clock::time_point now) {
  const auto end = later_.upper_bound(now);
  for (auto each = later_.begin(); each != end; ++each) tasks_.push_back(std::move(each->second));
  later_.erase(later_.begin(), end);
}

void Loop::run(std::chrono::milliseconds idle_after, const Task& idle) {
  using Clock = std::chrono::steady_clock;
  std::deque<Task> due;
  while (!stopped_) {
    {
      std::unique_lock lock(mutex_);
      const Clock::time_point end = Clock::now() + idle_after;
      for (take_due(Clock::now()); tasks_.empty() && Clock::now() < end; take_due(Clock::now()))
        task_added_.wait_until(lock, later_.empty() ? end : std::min(end, later_.begin()->first));
      due.swap(tasks_);
    }
    if (due.empty()) idle();
    for (; !due.empty() && !stopped_; due.pop_front()) due.front()();
  }
}

std::optional<std::chrono::steady_clock::time_point> Loop::run_due(std::chrono::steady_clock::time_point end) {
  using Clock = std::chrono::steady_clock;
  while (!stopped_) {
    Task task;
    {
      const std::lock_guard lock(mutex_);
      take_due(Clock::now());
      if (tasks_.empty()) return later_.empty() ? std::nullopt : std::optional(later_.begin()->first);
      task = std::move(tasks_.front());
      tasks_.pop_front();
    }
    task();
    if (const Clock::time_point now = Clock::now(); now >= end) return now;
  }
  return std::nullopt;
}

}  // namespace isocnc::rpc
