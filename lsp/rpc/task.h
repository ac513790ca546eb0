#pragma once

#include <functional>

namespace isocnc::rpc {

/// Work for a loop, a pool or a strand.
using Task = std::function<void()>;

}  // namespace isocnc::rpc
