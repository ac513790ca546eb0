#include "interpreter/threads/crew.h"

#include <utility>

#include "interpreter/threads/side_by_side.h"

namespace isocnc::threads {

/// Where more tasks wait, the caller helps rather than make still more: it comes back to that while the tasks do what
/// one thread has to do alone.
static constexpr std::size_t kManyTasks = 8;
static constexpr std::size_t kMostTasks = 16;

Crew::Crew(int size) : helpers_(start_threads(size - 1, [this] { help(); })) {}

Crew::~Crew() {
  wait();
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  changed_.notify_all();
  for (std::thread& helper : helpers_) helper.join();
}

void Crew::start(std::function<void()> task) {
  if (helpers_.empty()) return task();
  std::unique_lock lock(mutex_);
  tasks_.push_back(std::move(task));
  changed_.notify_all();
  if (tasks_.size() > kManyTasks && is_open_to(last_joined_)) join_work(lock, last_joined_);
  help_while(lock, [this] { return tasks_.size() > kMostTasks; });
}

void Crew::wait() {
  std::unique_lock lock(mutex_);
  help_while(lock, [this] { return is_running_ || !tasks_.empty(); });
}

void Crew::help_while(std::unique_lock<std::mutex>& lock, const std::function<bool()>& waits) {
  while (waits()) {
    changed_.wait(lock, [&] { return !waits() || is_open_to(last_joined_); });
    if (waits()) join_work(lock, last_joined_);
  }
}

void Crew::help() {
  std::unique_lock lock(mutex_);
  std::uint64_t last_joined = 0;
  while (true) {
    const auto has_task = [&] { return !is_running_ && !tasks_.empty(); };
    changed_.wait(lock, [&] { return ends_ || has_task() || is_open_to(last_joined); });
    if (ends_) return;
    if (!has_task()) {
      join_work(lock, last_joined);
      continue;
    }
    const std::function<void()> task = std::move(tasks_.front());
    tasks_.pop_front();
    changed_.notify_all();  // Who gives tasks may wait for this.
    is_running_ = true;
    lock.unlock();
    task();
    lock.lock();
    is_running_ = false;
    changed_.notify_all();
  }
}

void Crew::join_work(std::unique_lock<std::mutex>& lock, std::uint64_t& last_joined) {
  last_joined = open_.number;
  const std::function<void()>& work = *open_.work;
  ++open_.joined;
  lock.unlock();
  [&work]() noexcept { work(); }();
  lock.lock();
  if (--open_.joined == 0) changed_.notify_all();
}

void Crew::together(const std::function<void()>& work) {
  {
    const std::lock_guard lock(mutex_);
    open_.work = &work;
    ++open_.number;
  }
  changed_.notify_all();
  [&work]() noexcept { work(); }();
  std::unique_lock lock(mutex_);
  open_.work = nullptr;
  changed_.wait(lock, [&] { return open_.joined == 0; });
}

}  // namespace isocnc::threads
