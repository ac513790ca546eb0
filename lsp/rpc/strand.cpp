#include "lsp/rpc/strand.h"

#include <utility>

#include "interpreter/system/process.h"

namespace isocnc::rpc {

Pool::Pool(Loop& loop, std::size_t max_threads) : loop_(loop), max_threads_(system::has_threads() ? max_threads : 0) {}

Pool::~Pool() {
  std::deque<Task> dropped;
  {
    const std::lock_guard lock(mutex_);
    is_ending_ = true;
    dropped.swap(tasks_);
  }
  dropped.clear();
  task_added_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void Pool::post(Task task) {
  if (max_threads_ == 0) return loop_.post(std::move(task));
  const std::lock_guard lock(mutex_);
  if (is_ending_) return;  // A thread started now would not be joined.
  tasks_.push_back(std::move(task));
  if (tasks_.size() > waiting_ && threads_.size() < max_threads_) threads_.emplace_back([this] { work(); });
  task_added_.notify_one();
}

void Pool::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    ++waiting_;
    task_added_.wait(lock, [&] { return is_ending_ || !tasks_.empty(); });
    --waiting_;
    if (tasks_.empty()) return;
    const Task task = std::move(tasks_.front());
    tasks_.pop_front();
    lock.unlock();
    task();
    lock.lock();
  }
}

/// The pool's task that runs the tasks of a queue. If the pool drops it, the queue is emptied: its tasks may hold the
/// owner of the strand, and such a cycle of shared pointers would never be freed.
struct Strand::StrandTurn {
  std::shared_ptr<Queue> queue;
  bool has_come = false;

  explicit StrandTurn(std::shared_ptr<Queue> of) : queue(std::move(of)) {}
  StrandTurn(const StrandTurn&) = delete;
  StrandTurn& operator=(const StrandTurn&) = delete;
  ~StrandTurn() {
    if (has_come) return;
    std::deque<Task> dropped;  // Destroyed after the lock is released.
    const std::lock_guard lock(queue->mutex);
    dropped.swap(queue->tasks);
    queue->is_running = false;
  }
};

void Strand::post(Task task) {
  {
    const std::lock_guard lock(queue_->mutex);
    queue_->tasks.push_back(std::move(task));
    if (std::exchange(queue_->is_running, true)) return;
  }
  // Called without the lock, since a dropped turn takes it in its destructor.
  pool_.post([turn = std::make_shared<StrandTurn>(queue_)] {
    turn->has_come = true;
    run(*turn->queue);
  });
}

bool Strand::has_waiting() const {
  const std::lock_guard lock(queue_->mutex);
  return !queue_->tasks.empty();
}

void Strand::run(Queue& queue) {
  std::unique_lock lock(queue.mutex);
  while (!queue.tasks.empty()) {
    {
      const Task task = std::move(queue.tasks.front());
      queue.tasks.pop_front();
      lock.unlock();
      task();
    }
    lock.lock();
  }
  queue.is_running = false;
}

}  // namespace isocnc::rpc
