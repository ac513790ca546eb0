#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "interpreter/motion/limits.h"
#include "interpreter/motion/machine.h"
#include "interpreter/motion/memory.h"
#include "interpreter/motion/piece.h"
#include "interpreter/motion/smooth_motion.h"
#include "interpreter/motion/stretch.h"

namespace isocnc::motion {

/// Gives pieces of path their time on a machine whose jerk is limited: a SmoothMotion from each rest to the next, each
/// smoothed as makes its beginning shortest. A value.
class JerkLimiter {
 public:
  /// `feed_cap`: most x.
  void append(const Machine& machine, const Piece& piece, double feed_cap);
  void come_to_rest(const Machine& machine);
  void wait(double seconds) { time_ += seconds; }

  /// The next stretch that is determined, or null. Valid until the jerk limiter is used again.
  const Stretch* next();

  void forget_handed_out() {
    if (motion_) motion_->forget_handed_out();
  }

  /// Bytes that it holds, beside itself.
  std::size_t memory() const {
    return bytes_of(first_pieces_) + bytes_of(finished_) + (motion_ ? motion_->memory() : 0);
  }

  /// Seconds until the end of all that is determined.
  double time() const { return motion_ ? motion_->time() : time_; }

 private:
  struct PendingPiece {
    Piece piece;
    DerivativeBounds bounds;
    double feed_cap;
  };

  void begin(const Machine& machine);
  Smoothing best_smoothing(const Machine& machine) const;
  double time_with(const Machine& machine, const Smoothing& smoothing) const;

  std::vector<PendingPiece> first_pieces_;  ///< After a rest, until they are enough to choose the smoothing.
  std::optional<SmoothMotion> motion_;
  std::vector<Stretch> finished_;  ///< Of motions that have come to rest.
  std::size_t handed_out_ = 0;
  double time_ = 0;  ///< At rest.
};

}  // namespace isocnc::motion
