#pragma once

#include <limits>
#include <numbers>

namespace isocnc::kinematics {

inline constexpr double kRadians = std::numbers::pi / 180;  ///< Radians per degree.
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kNoLength = 1e-12;  ///< Lengths below this are rounding errors, mm or degrees.
inline constexpr double kSecondsPerMinute = 60;

constexpr double square(double value) { return value * value; }

}  // namespace isocnc::kinematics
