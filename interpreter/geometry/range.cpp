#include "interpreter/geometry/range.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace isocnc::geometry {

void Range::include(const Range& other) {
  minimum = std::min(minimum, other.minimum);
  maximum = std::max(maximum, other.maximum);
}

Turn turn_of(double angle) { return {angle, std::cos(angle), std::sin(angle)}; }

/// Whether the direction of (p, q) lies between angle 0 and the end.
static bool passes(double p, double q, const Turn& end) {
  const double beyond = end.cosine * q - end.sine * p;
  if (end.angle >= 2 * std::numbers::pi) return true;
  return end.angle <= std::numbers::pi ? q >= 0 && beyond <= 0 : q >= 0 || beyond <= 0;
}

/// p cos t + q sin t has its maximum where t is the direction of (p, q), and its minimum at the opposite direction.
static Range level_wave_range(double p, double q, const Turn& end, double last) {
  Range range{std::min(p, last), std::max(p, last)};
  const double amplitude = std::sqrt(p * p + q * q);
  if (passes(p, q, end)) range.maximum = std::max(range.maximum, amplitude);
  if (passes(-p, -q, end)) range.minimum = std::min(range.minimum, -amplitude);
  return range;
}

/// Between the ends a minimum or maximum requires derivative zero: amplitude sin(t - phase) = slope. There the wave is
/// amplitude cos(t - phase).
static Range wave_range(double p, double q, double slope, const Turn& end) {
  const double last = end.cosine * p + end.sine * q + end.angle * slope;
  if (slope == 0) return level_wave_range(p, q, end, last);
  Range range{std::min(p, last), std::max(p, last)};
  const double square = p * p + q * q;
  const double height = square - slope * slope;
  if (square == 0 || height < 0) return range;
  const double phase = std::atan2(q, p);
  const double rising = std::asin(slope / std::sqrt(square));
  constexpr double kTurn = 2 * std::numbers::pi;
  const auto include_turns = [&](double turning, double wave) {
    for (double t = turning - kTurn * std::ceil(turning / kTurn); t <= end.angle; t += kTurn)
      if (t > 0) range.include({wave + slope * t, wave + slope * t});
  };
  include_turns(phase + rising, std::sqrt(height));
  include_turns(phase + std::numbers::pi - rising, -std::sqrt(height));
  return range;
}

Range wave_range(double p, double q, double slope, double end) { return wave_range(p, q, slope, turn_of(end)); }

std::array<Range, 3> wave_ranges(const Vec3& center, const Vec3& p, const Vec3& q, const Vec3& slope, const Turn& end) {
  std::array<Range, 3> ranges;
  for (int axis = 0; axis < 3; ++axis) {
    const Range wave = wave_range(p[axis], q[axis], slope[axis], end);
    ranges[static_cast<std::size_t>(axis)] = {center[axis] + wave.minimum, center[axis] + wave.maximum};
  }
  return ranges;
}

}  // namespace isocnc::geometry
