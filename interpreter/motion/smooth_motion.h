#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "interpreter/kinematics/limits.h"
#include "interpreter/kinematics/machine.h"
#include "interpreter/motion/memory.h"
#include "interpreter/motion/moving_average.h"
#include "interpreter/motion/peak_trimmer.h"
#include "interpreter/motion/piece.h"
#include "interpreter/motion/profile.h"
#include "interpreter/motion/stretch.h"
#include "interpreter/motion/window_minimum.h"

namespace isocnc::motion {

/// Computes the times of pieces of path on a machine whose jerk is limited, with a given Smoothing. It runs these steps
/// one after another: smoothed_limits(), WindowMinimum, Profile, PeakTrimmer, MovingAverage; and cuts the resulting
/// phases into stretches where pieces meet (docs/motion.md, "Jerk"). The pieces must follow one another with continuous
/// second derivatives of all joints. The class has value semantics.
class SmoothMotion {
 public:
  /// `start`: time at which the motion starts, s.
  SmoothMotion(const kinematics::Machine& machine, const kinematics::Smoothing& smoothing, double start);

  /// Appends a piece. `bounds`: bounds of the joints' derivatives on it. `feed_cap`: maximum of (ds/dt)^2 by the feed,
  /// mm^2/s^2.
  void append(const kinematics::Machine& machine, const Piece& piece, const kinematics::DerivativeBounds& bounds,
              double feed_cap);
  /// Ends the motion at rest after the pieces appended so far.
  void come_to_rest();

  /// Returns the next stretch whose times are final, or null. The pointer is valid until the next call of a non-const
  /// member function.
  const Stretch* next();

  /// Frees the memory of spans whose phases have been taken.
  void forget_handed_out() { profile_.forget_handed_out(); }

  /// Returns the number of bytes held outside the object itself.
  std::size_t memory() const {
    return window_minimum_.memory() + profile_.memory() + peak_trimmer_.memory() + average_.memory() +
           bytes_of(smooth_) + bytes_of(pieces_) + bytes_of(stretches_);
  }

  /// Returns the time at the end of all that is final, s.
  double time() const { return time_; }

 private:
  struct PlacedPiece {
    Piece piece;
    double begin = 0;  ///< Distance along the path from the last rest, mm or degrees.
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

  kinematics::Smoothing smoothing_;
  double max_speed_;  ///< Upper bound of the speed along any path, mm/s.
  WindowMinimum window_minimum_;
  Profile profile_;
  PeakTrimmer peak_trimmer_;
  MovingAverage average_;
  std::vector<Phase> smooth_;       ///< Phases of the mean that are not yet cut into stretches.
  std::deque<PlacedPiece> pieces_;  ///< Pieces that have no complete stretches yet.
  double end_ = 0;                  ///< End of the last piece, as a distance from the last rest.
  std::size_t batch_;               ///< Number of pieces that triggers planning.
  double time_;                     ///< Time at the end of the last finished stretch, s.
  Stretch stretch_;                 ///< Stretch of the first of `pieces_`, still growing.
  std::vector<Stretch> stretches_;  ///< Finished stretches.
  std::size_t handed_out_ = 0;      ///< Number of `stretches_` that next() has returned.
};

}  // namespace isocnc::motion
