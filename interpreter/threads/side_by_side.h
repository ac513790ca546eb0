#pragma once

#include <functional>
#include <thread>
#include <vector>

namespace isocnc::threads {

/// Starts threads that do the work; fewer, even none, if the system gives no more. An exception that leaves `work`
/// terminates the program.
std::vector<std::thread> start_threads(int count, const std::function<void()>& work);

/// Runs `work` on this thread and on `workers` - 1 others (fewer if the system gives no more), and returns when all
/// have ended. With several threads, an exception that leaves `work` terminates the program: the others may be waiting
/// for the work that failed.
void side_by_side(int workers, const std::function<void()>& work);

/// The same on all processors that the process may use.
void on_all_processors(const std::function<void()>& work);

}  // namespace isocnc::threads
