#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "interpreter/motion/erosion.h"
#include "interpreter/motion/limits.h"
#include "interpreter/motion/machine.h"
#include "interpreter/motion/memory.h"
#include "interpreter/motion/moving_average.h"
#include "interpreter/motion/piece.h"
#include "interpreter/motion/plateaus.h"
#include "interpreter/motion/profile.h"
#include "interpreter/motion/stretch.h"

namespace isocnc::motion {

/// Gives pieces of path their time on a machine whose jerk is limited: a Profile under limits that are spread over
/// their surroundings, and its mean over a window of time (docs/motion.md). Pieces follow one another with continuous
/// second derivatives of all joints; they go in one by one, and come out as stretches. A value.
class SmoothMotion {
 public:
  /// From `start` on.
  SmoothMotion(const Machine& machine, const Smoothing& smoothing, double start);

  /// `feed_cap`: most x.
  void append(const Machine& machine, const Piece& piece, const Slopes& slopes, double feed_cap);
  void come_to_rest();

  /// The next stretch that is determined, or null. Valid until the softener is used again.
  const Stretch* next();

  void forget_handed_out() { profile_.forget_handed_out(); }

  /// Bytes that it holds, beside itself.
  std::size_t memory() const {
    return erosion_.memory() + profile_.memory() + plateaus_.memory() + average_.memory() + bytes_of(smooth_) +
           bytes_of(pieces_) + bytes_of(stretches_);
  }

  /// Seconds until the end of all that is determined.
  double time() const { return time_; }

 private:
  struct PlacedPiece {
    Piece piece;
    double begin = 0;  ///< From the last rest on.
    double end() const { return begin + piece.length; }
  };

  void take_cells();
  void take_phases();
  void take_plateaus();
  void pause();
  void lay(Phase phase);
  void add(Phase phase);
  void finish_piece();
  void emit(bool ends_move);

  Smoothing smoothing_;
  double most_speed_;
  Erosion erosion_;
  Profile profile_;
  Plateaus plateaus_;
  MovingAverage average_;
  std::vector<Phase> smooth_;  ///< What is being laid on the pieces.
  std::deque<PlacedPiece> pieces_;
  double end_ = 0;     ///< Of the last piece.
  std::size_t batch_;  ///< So many pieces call for planning.
  double time_;
  Stretch stretch_;  ///< Of the first piece, as far as it is known.
  std::vector<Stretch> stretches_;
  std::size_t handed_out_ = 0;
};

}  // namespace isocnc::motion
