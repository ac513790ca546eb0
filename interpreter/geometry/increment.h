#pragma once

#include <cmath>

namespace isocnc::geometry {

/// Increments are counted in steps of a billionth of a mm or degree; no control has finer ones. Whole steps add up
/// without rounding, so that moves in G91 are bit-identical from any start position.
inline constexpr double kStepsPerUnit = 1e9;

/// Maximum position, mm or degrees, up to which positions are counted in whole steps.
inline constexpr double kFarthestStep = 1e6;

namespace detail {
/// The nearest whole number of a value below 2^51.
inline double whole(double value) {
  constexpr double kShift = 6755399441055744.0;  // 1.5 * 2^52: a value added to it loses its fraction.
  return (value + kShift) - kShift;
}
}  // namespace detail

/// The position plus an increment, in mm or degrees.
inline double advanced(double position, double increment) {
  const double sum = position + increment;
  if (!(std::abs(position) <= kFarthestStep && std::abs(increment) <= kFarthestStep)) return sum;
  return (detail::whole(position * kStepsPerUnit) + detail::whole(increment * kStepsPerUnit)) / kStepsPerUnit;
}

/// Whether the position is a whole number of steps, and small enough for advanced() to be exact.
inline bool is_on_step(double position) {
  return std::abs(position) <= kFarthestStep && detail::whole(position * kStepsPerUnit) / kStepsPerUnit == position;
}

}  // namespace isocnc::geometry
