#pragma once

#include <limits>
#include <numbers>

namespace isocnc::motion {

inline constexpr double kRadians = std::numbers::pi / 180;  ///< In a degree.
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kNoLength = 1e-12;  ///< mm or degrees: what is shorter is a rounding error.
inline constexpr double kSecondsPerMinute = 60;

constexpr double square(double value) { return value * value; }

}  // namespace isocnc::motion
