#pragma once

#include <cstddef>
#include <deque>

#include "interpreter/motion/memory.h"
#include "interpreter/motion/stretch.h"

namespace isocnc::motion {

/// Makes a motion keep its speed for a time wherever it turns from gathering to losing it, by cutting its peaks. Phases
/// of constant acceleration go in and come out, one after another; a valley lasts as long already. A value.
class PeakTrimmer {
 public:
  explicit PeakTrimmer(double min_duration) : min_duration_(min_duration) {}

  void append(const Phase& phase);

  /// The last phase has led to rest.
  void come_to_rest();

  bool has_next() const { return settled_ > 0; }
  /// Only while has_next().
  Phase next();

  /// Bytes that it holds, beside itself.
  std::size_t memory() const { return bytes_of(phases_); }

 private:
  void settle();
  void trim_peak();
  void replace(std::size_t first, std::size_t last, double speed);

  double min_duration_;
  std::deque<Phase> phases_;
  std::size_t settled_ = 0;    ///< So many phases can go.
  double unsettled_time_ = 0;  ///< Of the others.
  bool is_rising_ = false;     ///< What changed the speed last.
  bool has_peak_ = false;
  std::size_t peak_ = 0;  ///< The first phase that loses speed after it.
  double fallen_time_ = 0;
};

}  // namespace isocnc::motion
