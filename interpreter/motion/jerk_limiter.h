#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "interpreter/kinematics/limits.h"
#include "interpreter/kinematics/machine.h"
#include "interpreter/motion/memory.h"
#include "interpreter/motion/piece.h"
#include "interpreter/motion/smooth_motion.h"
#include "interpreter/motion/stretch.h"

namespace isocnc::motion {

/// Computes the times of pieces of path on a machine whose jerk is limited. From each rest to the next it runs one
/// SmoothMotion, with the Smoothing that makes the first pieces after the rest take the shortest time. The class has
/// value semantics: a copy is independent.
class JerkLimiter {
 public:
  /// Appends a piece. `feed_cap`: maximum of (ds/dt)^2 by the feed, mm^2/s^2.
  void append(const kinematics::Machine& machine, const Piece& piece, double feed_cap);
  /// Appends a piece that takes a given phase. Requires that the machine is at rest, and comes to rest after the last
  /// one of a sequence of such pieces.
  void append_phase(const Piece& piece, const Phase& phase);
  /// Ends the motion at rest after the pieces appended so far.
  void come_to_rest(const kinematics::Machine& machine);
  /// Stays at rest for a time, s. Requires that the machine is at rest.
  void wait(double seconds) { time_ += seconds; }

  /// Returns the next stretch whose times are final, or null. The pointer is valid until the next call of any other
  /// member function, or of this one.
  const Stretch* next();

  /// Frees the memory of stretches that next() has returned.
  void forget_handed_out() {
    if (motion_) motion_->forget_handed_out();
  }

  /// Returns the number of bytes held outside the object itself.
  std::size_t memory() const {
    return bytes_of(first_pieces_) + bytes_of(finished_) + (motion_ ? motion_->memory() : 0);
  }

  /// Returns the time at the end of all that is final, s.
  double time() const { return motion_ ? motion_->time() : time_; }

 private:
  struct PendingPiece {
    Piece piece;
    kinematics::DerivativeBounds bounds;  ///< Bounds of the joints' derivatives on the piece.
    double feed_cap;                      ///< Maximum of (ds/dt)^2 by the feed, mm^2/s^2.
  };

  void begin(const kinematics::Machine& machine);
  kinematics::Smoothing best_smoothing(const kinematics::Machine& machine) const;
  double time_with(const kinematics::Machine& machine, const kinematics::Smoothing& smoothing) const;

  std::vector<PendingPiece> first_pieces_;  ///< Pieces after a rest, until they suffice to choose the smoothing.
  std::optional<SmoothMotion> motion_;      ///< Motion since the last rest; absent until the smoothing is chosen.
  std::vector<Stretch> finished_;           ///< Stretches of motions that have come to rest.
  std::size_t handed_out_ = 0;              ///< Number of `finished_` that next() has returned.
  double time_ = 0;                         ///< Time at the last rest, s.
};

}  // namespace isocnc::motion
