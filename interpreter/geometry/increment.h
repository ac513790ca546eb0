#pragma once

#include <cmath>

namespace isocnc::geometry {

/// Increments are counted in steps of a billionth of a mm, or degree: no control has finer ones. Whole steps add up
/// without any rounding, so that moves in G91 take the same way to the last bit from wherever they begin.
inline constexpr double kStepsPerUnit = 1e9;

/// Positions up to here, mm or degrees, are whole steps away from each other.
inline constexpr double kFarthestStep = 1e6;

namespace detail {
/// The nearest whole number of a value below 2^51.
inline double whole(double value) {
  constexpr double kShift = 6755399441055744.0;  // 1.5 * 2^52: what is added to it loses its fraction.
  return (value + kShift) - kShift;
}
}  // namespace detail

/// A position so many mm, or degrees, farther on.
inline double advanced(double position, double increment) {
  const double sum = position + increment;
  if (!(std::abs(position) <= kFarthestStep && std::abs(increment) <= kFarthestStep)) return sum;
  return (detail::whole(position * kStepsPerUnit) + detail::whole(increment * kStepsPerUnit)) / kStepsPerUnit;
}

/// Whether the position is a whole number of steps, and near enough that others can be found from it by advanced().
inline bool is_on_step(double position) {
  return std::abs(position) <= kFarthestStep && detail::whole(position * kStepsPerUnit) / kStepsPerUnit == position;
}

}  // namespace isocnc::geometry
