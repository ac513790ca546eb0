#pragma once

#include <functional>

namespace isocnc::check {

/// Does `work` on this thread and on `workers` - 1 others, on fewer where the system gives no more, until all have
/// ended. With several, an exception that leaves `work` ends the program: the others may be waiting for what it was to
/// do.
void side_by_side(int workers, const std::function<void()>& work);

}  // namespace isocnc::check
