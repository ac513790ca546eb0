#pragma once

#include <cstdint>
#include <vector>

namespace isocnc::breakpoints {

/// The blocks, by their number in the run, at which a breakpoint has been hit so far. A block that the run comes to
/// again is the same hit as before. A breakpoint that the client sets again as it was, because it has changed another
/// one, goes on counting.
class HitCounter {
 public:
  /// The number of the hit, from 1.
  std::uint64_t count(std::uint64_t block);
  /// The run has been changed at this block: hits from there on are void.
  void forget_from(std::uint64_t block);

 private:
  std::vector<std::uint64_t> blocks_;  ///< In order.
};

}  // namespace isocnc::breakpoints
