#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "interpreter/motion/memory.h"
#include "interpreter/motion/stretch.h"

namespace isocnc::motion {

/// Replaces a motion s(t) by its mean over a window of time. Where the acceleration of the motion steps, that of the
/// mean changes at a constant jerk. Phases of constant acceleration go in, phases of constant jerk come out. From rest
/// to rest the mean lasts one window longer than the motion. The class has value semantics.
class MovingAverage {
 public:
  /// `window`: length of the window, s.
  explicit MovingAverage(double window) : window_(window) {}

  /// Takes the next phase of the motion, and appends to `out` the phases of the mean that it determines.
  void append(const Phase& phase, std::vector<Phase>& out);

  /// Ends the motion at rest, and appends the last phases of the mean to `out`.
  void come_to_rest(std::vector<Phase>& out);

  /// Returns the number of bytes held outside the object itself.
  std::size_t memory() const { return bytes_of(lag_); }

 private:
  void begin(double from);
  void step(const Phase& lead, double duration, std::vector<Phase>& out);

  double window_;          ///< Length of the window, s.
  std::deque<Phase> lag_;  ///< Phases of the motion from the window's trailing edge on.
  double lag_time_ = 0;    ///< Time of the trailing edge within the first of `lag_`, s.
  double s_ = 0;           ///< Current mean, mm or degrees.
};

}  // namespace isocnc::motion
