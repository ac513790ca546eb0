#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace isocnc::lsp::rpc {

/// Threads that come into being when there is work for them, up to a bound, and wait for more when it is done.
class Pool {
 public:
  using Task = std::function<void()>;

  explicit Pool(std::size_t max_threads) : max_threads_(max_threads) {}
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;
  /// Waits for the tasks that have begun; the others are dropped.
  ~Pool();

  /// Dropped when the pool is ending.
  void post(Task task);

 private:
  void work();

  const std::size_t max_threads_;
  std::mutex mutex_;  // Guards all below.
  std::condition_variable task_added_;
  std::deque<Task> tasks_;
  std::vector<std::thread> threads_;
  std::size_t waiting_ = 0;
  bool is_ending_ = false;
};

/// Tasks that are done in the order in which they come, one at a time, while those of other strands go on beside them.
/// What only the tasks of one strand touch needs no lock.
class Strand {
 public:
  explicit Strand(Pool& pool) : pool_(pool), queue_(std::make_shared<Queue>()) {}

  void post(Pool::Task task);

 private:
  struct Queue {
    std::mutex mutex;
    std::deque<Pool::Task> tasks;
    bool is_running = false;
  };
  struct Turn;

  static void run(Queue& queue);

  Pool& pool_;
  std::shared_ptr<Queue> queue_;
};

}  // namespace isocnc::lsp::rpc
