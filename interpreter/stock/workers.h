#pragma once

#include <cstddef>
#include <functional>

namespace isocnc::stock {

/// Runs `work` on one or several threads at once, and returns when all have ended.
using Workers = std::function<void(const std::function<void()>& work)>;

/// Calls `use` once with each number below `count`, on the caller's thread or, if there are workers and more than one
/// number, on theirs. The small numbers begin first.
void for_each_number(const Workers& workers, std::size_t count, const std::function<void(std::size_t number)>& use);

}  // namespace isocnc::stock
