#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "lsp/rpc/loop.h"
#include "lsp/rpc/task.h"

namespace isocnc::rpc {

/// A thread pool. Threads are created when there is work for them, up to a maximum, and then wait for more. Where the
/// system has no threads, or the maximum is 0, the tasks run on the loop, one after another.
class Pool {
 public:
  Pool(Loop& loop, std::size_t max_threads);
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;
  /// Waits for the tasks that have started; the others are dropped.
  ~Pool();

  /// Runs the task on some thread; drops it if the pool is being destroyed.
  void post(Task task);

 private:
  void work();

  Loop& loop_;
  const std::size_t max_threads_;
  std::mutex mutex_;  // Guards the members below.
  std::condition_variable task_added_;
  std::deque<Task> tasks_;
  std::vector<std::thread> threads_;
  std::size_t waiting_ = 0;
  bool is_ending_ = false;
};

/// Runs its tasks one at a time, in the order of post(), and in parallel to other strands. Data that only the tasks of
/// one strand touch needs no lock.
class Strand {
 public:
  explicit Strand(Pool& pool) : pool_(pool), queue_(std::make_shared<Queue>()) {}

  void post(Task task);
  /// Whether tasks wait for the one that is running.
  bool has_waiting() const;

 private:
  struct Queue {
    std::mutex mutex;
    std::deque<Task> tasks;
    bool is_running = false;
  };
  struct StrandTurn;

  static void run(Queue& queue);

  Pool& pool_;
  std::shared_ptr<Queue> queue_;
};

}  // namespace isocnc::rpc
