#pragma once

#include <functional>
#include <thread>
#include <vector>

namespace isocnc::support {

/// What runs work on this thread and on others, `count` in all, as verification and stock are given it.
inline std::function<void(const std::function<void()>& work)> on_threads(int count) {
  return [count](const std::function<void()>& work) {
    std::vector<std::thread> others;
    for (int i = 1; i < count; ++i) others.emplace_back(work);
    work();
    for (std::thread& thread : others) thread.join();
  };
}

}  // namespace isocnc::support
