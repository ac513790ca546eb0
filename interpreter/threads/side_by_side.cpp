#include "interpreter/threads/side_by_side.h"

#include <system_error>

#include "interpreter/system/process.h"

namespace isocnc::threads {

std::vector<std::thread> start_threads(int count, const std::function<void()>& work) {
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

void on_all_processors(const std::function<void()>& work) { side_by_side(system::processor_count(), work); }

}  // namespace isocnc::threads
