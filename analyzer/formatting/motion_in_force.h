#pragma once

#include <cstdint>

#include "interpreter/syntax/forward_paths.h"

namespace isocnc::formatting {

/// Which motion G is in force before each line of a program, on all paths that lead there. Is shown all lines, in
/// order; it judges no condition, so it follows more paths than there are.
class MotionInForce {
 public:
  static constexpr std::uint8_t kUnknown = 253;     ///< An error stands before it, or paths differ.
  static constexpr std::uint8_t kNotReached = 254;  ///< An M02 stands before it, and no jump leads there.
  static constexpr std::uint8_t kNoMotion = dialect::kNoMotion;

  /// Comes to the line; in_force() then answers for it.
  void enter(const syntax::LineTree& line) { paths_.arrive(line); }
  /// Goes over the line.
  void leave(const syntax::LineTree& line);

  /// 0 to 3, or one of the above.
  std::uint8_t in_force() const { return paths_.live.number; }
  bool is_known() const { return in_force() <= 3; }

 private:
  struct Motion {
    std::uint8_t number = kNotReached;

    bool empty() const { return number == kNotReached; }
    void join(Motion&& other) {
      if (number != other.number) number = kUnknown;
    }
    void pass(const syntax::LineTree& line);
  };

  syntax::ForwardPaths<Motion> paths_{Motion{kNoMotion}};
};

}  // namespace isocnc::formatting
