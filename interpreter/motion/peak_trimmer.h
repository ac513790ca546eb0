#pragma once

#include <cstddef>
#include <deque>

#include "interpreter/motion/memory.h"
#include "interpreter/motion/stretch.h"

namespace isocnc::motion {

/// Lowers each peak of the speed to a plateau that lasts for at least `min_duration`. Phases of constant acceleration
/// go in and come out in order. Valleys are left alone: the window minimum has made each last long enough. The class
/// has value semantics.
class PeakTrimmer {
 public:
  /// `min_duration`: minimum duration of a plateau, s.
  explicit PeakTrimmer(double min_duration) : min_duration_(min_duration) {}

  void append(const Phase& phase);

  /// Ends the motion: the last phase appended leads to rest.
  void come_to_rest();

  bool has_next() const { return settled_ > 0; }
  /// Returns the next phase. Requires has_next().
  Phase next();

  /// Returns the number of bytes held outside the object itself.
  std::size_t memory() const { return bytes_of(phases_); }

 private:
  void settle();
  void trim_peak();
  void replace(std::size_t first, std::size_t last, double speed);

  double min_duration_;        ///< Minimum duration of a plateau, s.
  std::deque<Phase> phases_;   ///< Phases that next() has not returned.
  std::size_t settled_ = 0;    ///< Number of leading phases that no later trimming can change.
  double unsettled_time_ = 0;  ///< Duration of the phases after the settled ones, s.
  bool is_rising_ = false;     ///< Whether the last change of speed was an increase.
  bool has_peak_ = false;      ///< Whether a peak waits to be trimmed.
  std::size_t peak_ = 0;       ///< Index of the first decelerating phase after the peak.
  double fallen_time_ = 0;     ///< Duration of the phases from `peak_` on, s.
};

}  // namespace isocnc::motion
