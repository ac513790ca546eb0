#include "analyzer/check/side_by_side.h"

#include <algorithm>
#include <system_error>
#include <thread>
#include <vector>

namespace isocnc::check {

void side_by_side(int workers, const std::function<void()>& work) {
  if (workers <= 1) {
    work();
    return;
  }
  const auto work_or_end = [&work]() noexcept { work(); };
  std::vector<std::thread> helpers;
  try {
    while (static_cast<int>(helpers.size()) + 1 < workers) helpers.emplace_back(work_or_end);
  } catch (const std::system_error&) {  // The threads already started suffice.
  }
  work_or_end();
  for (std::thread& helper : helpers) helper.join();
}

int processor_count() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

void on_all_processors(const std::function<void()>& work) { side_by_side(processor_count(), work); }

}  // namespace isocnc::check
