#pragma once

#include <cstdint>
#include <unordered_map>

#include "interpreter/syntax/line_tree.h"

namespace isocnc::formatting {

/// Which motion G is in force before each line of a program, whatever way led there. Is shown all lines, in order; it
/// knows jumps by their labels and judges no condition, so it follows more paths than there are.
class MotionInForce {
 public:
  static constexpr std::uint8_t kNotKnown = 253;    ///< An error stands before it, or paths differ.
  static constexpr std::uint8_t kNotReached = 254;  ///< Behind an M02, and no jump leads there.
  static constexpr std::uint8_t kNoMotion = dialect::kNoMotion;

  /// At the start of the line; to be asked for in_force() then.
  void enter(const syntax::LineTree& line);
  /// Behind the line.
  void leave(const syntax::LineTree& line);

  /// 0 to 3, or one of the above.
  std::uint8_t in_force() const { return in_force_; }
  bool is_known() const { return in_force_ <= 3; }

 private:
  std::uint8_t in_force_ = kNoMotion;
  std::unordered_map<std::uint64_t, std::uint8_t> waiting_;  // By the label that a jump leads to.
};

}  // namespace isocnc::formatting
