#include "debugger/breakpoints/hit_counter.h"

#include <algorithm>

namespace isocnc::breakpoints {

std::uint64_t HitCounter::count(std::uint64_t block) {
  const auto place = std::lower_bound(blocks_.begin(), blocks_.end(), block);
  const auto number = static_cast<std::uint64_t>(place - blocks_.begin()) + 1;
  if (place == blocks_.end() || *place != block) blocks_.insert(place, block);
  return number;
}

void HitCounter::forget_from(std::uint64_t block) {
  blocks_.erase(std::lower_bound(blocks_.begin(), blocks_.end(), block), blocks_.end());
}

}  // namespace isocnc::breakpoints
