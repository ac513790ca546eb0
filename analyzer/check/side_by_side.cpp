#include "analyzer/check/side_by_side.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace isocnc::check {

/// Threads that do the work, at most `count`; those that the system gives suffice.
static std::vector<std::thread> start_threads(int count, const std::function<void()>& work) {
  std::vector<std::thread> threads;
  try {
    while (static_cast<int>(threads.size()) < count) threads.emplace_back([work]() noexcept { work(); });
  } catch (const std::system_error&) {
  }
  return threads;
}

void side_by_side(int workers, const std::function<void()>& work) {
  if (workers <= 1) {
    work();
    return;
  }
  std::vector<std::thread> helpers = start_threads(workers - 1, [&work] { work(); });
  [&work]() noexcept { work(); }();
  for (std::thread& helper : helpers) helper.join();
}

int processor_count() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

void on_all_processors(const std::function<void()>& work) { side_by_side(processor_count(), work); }

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
  wait();
  {
    const std::lock_guard lock(mutex_);
    task_ = std::move(task);
    is_running_ = true;
  }
  changed_.notify_all();
}

void Crew::wait() {
  std::unique_lock lock(mutex_);
  std::uint64_t last_joined = 0;
  while (is_running_) {
    changed_.wait(lock, [&] { return !is_running_ || (open_.work && open_.number != last_joined); });
    if (is_running_) join_work(lock, last_joined);
  }
}

void Crew::help() {
  std::unique_lock lock(mutex_);
  std::uint64_t last_joined = 0;
  while (true) {
    changed_.wait(lock, [&] { return ends_ || task_ || (open_.work && open_.number != last_joined); });
    if (ends_) return;
    if (!task_) {
      join_work(lock, last_joined);
      continue;
    }
    const std::function<void()> task = std::exchange(task_, nullptr);
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

}  // namespace isocnc::check
