#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "interpreter/motion/memory.h"
#include "interpreter/motion/stretch.h"

namespace isocnc::motion {

/// The mean of s over a window of time, from rest to rest: where a motion changes its acceleration in steps, its mean
/// does so at a constant jerk. Phases of constant acceleration go in, those of constant jerk come out; all together
/// they last a window longer. A value.
class MovingAverage {
 public:
  explicit MovingAverage(double window) : window_(window) {}

  /// Appends to `out` what is known by then.
  void append(const Phase& phase, std::vector<Phase>& out);

  /// The last phase has led to rest.
  void come_to_rest(std::vector<Phase>& out);

  /// Bytes that it holds, beside itself.
  std::size_t memory() const { return bytes_of(lag_); }

 private:
  void begin(double from);
  void step(const Phase& lead, double duration, std::vector<Phase>& out);

  double window_;
  std::deque<Phase> lag_;  ///< From one window before on.
  double lag_time_ = 0;    ///< Gone in the first of them.
  double s_ = 0;           ///< The mean.
};

}  // namespace isocnc::motion
