#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "interpreter/motion/limits.h"
#include "interpreter/motion/machine.h"
#include "interpreter/motion/memory.h"
#include "interpreter/motion/moving_average.h"
#include "interpreter/motion/peak_trimmer.h"
#include "interpreter/motion/piece.h"
#include "interpreter/motion/profile.h"
#include "interpreter/motion/stretch.h"
#include "interpreter/motion/window_minimum.h"

namespace isocnc::motion {

/// Gives pieces of path their time on a machine whose jerk is limited: a Profile under limits that are spread over
/// their surroundings, and its mean over a window of time (docs/motion.md). Pieces follow one another with continuous
/// second derivatives of all joints; they go in one by one, and come out as stretches. A value.
class SmoothMotion {
 public:
  /// From `start` on.
  SmoothMotion(const Machine& machine, const Smoothing& smoothing, double start);

  /// `feed_cap`: most x.
  void append(const Machine& machine, const Piece& piece, const DerivativeBounds& bounds, double feed_cap);
  void come_to_rest();

  /// The next stretch that is determined, or null. Valid until the motion is used again.
  const Stretch* next();

  void forget_handed_out() { profile_.forget_handed_out(); }

  /// Bytes that it holds, beside itself.
  std::size_t memory() const {
    return window_minimum_.memory() + profile_.memory() + peak_trimmer_.memory() + average_.memory() +
           bytes_of(smooth_) + bytes_of(pieces_) + bytes_of(stretches_);
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
  void take_trimmed_phases();
  void pause();
  void place_on_pieces(Phase phase);
  void add(Phase phase);
  void finish_piece();
  void emit(bool ends_move);

  Smoothing smoothing_;
  double max_speed_;
  WindowMinimum window_minimum_;
  Profile profile_;
  PeakTrimmer peak_trimmer_;
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
