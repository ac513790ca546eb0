#pragma once

#include <cstdint>

#include "interpreter/syntax/forward_paths.h"

namespace isocnc::formatting {

/// The motion G in force before each line of a program, on all paths that lead there. Needs all lines, in order. It
/// does not evaluate conditions, so it also follows paths that are not feasible.
class MotionInForce {
 public:
  static constexpr std::uint8_t kUnknown = 253;     ///< After an error, or if paths differ.
  static constexpr std::uint8_t kNotReached = 254;  ///< After M02, without a jump to the line.
  static constexpr std::uint8_t kNoMotion = dialect::kNoMotion;

  /// Enters the line; in_force() then refers to the state before it.
  void enter(const syntax::LineTree& line) { paths_.arrive(line); }
  /// Passes the line.
  void leave(const syntax::LineTree& line);

  /// 0 to 3, or one of the constants above.
  std::uint8_t in_force() const { return paths_.live.number; }
  bool is_known() const { return dialect::is_motion_number(in_force()); }
  /// Whether the block above may lack words that start this line: with a number or a motion of its own the line would
  /// be another block.
  bool follows_lack() const { return follows_lack_; }
  /// Whether the line may be the rest of the block above, as it starts with a word which that may lack: with a number,
  /// or another word at its start, it would be another block.
  bool may_go_on(const syntax::LineTree& line) const;

 private:
  bool lacks_words(const syntax::LineTree& line) const;

  struct MotionWords {
    std::uint8_t number = kNotReached;

    bool empty() const { return number == kNotReached; }
    void join(MotionWords&& other) {
      if (number != other.number) number = kUnknown;
    }
    void pass(const syntax::LineTree& line);
  };

  syntax::ForwardPaths<MotionWords> paths_{MotionWords{kNoMotion}};
  bool follows_lack_ = false;
};

/// Whether a motion has coordinates, an arc R or two of I J K, and neither has words that it does not take.
bool is_sound(const syntax::LineTree& line, const syntax::Instruction& motion, const dialect::GCode& code);

}  // namespace isocnc::formatting
