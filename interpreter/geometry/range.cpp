#include "interpreter/geometry/range.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace isocnc::geometry {

void Range::include(const Range& other) {
  least = std::min(least, other.least);
  most = std::max(most, other.most);
}

/// Between the ends it can only turn where its slope is zero: amplitude sin(t - phase) = slope. There the wave is
/// amplitude cos(t - phase). `last`: its value at the end.
static Range wave_range(double p, double q, double slope, double end, double last) {
  Range range{std::min(p, last), std::max(p, last)};
  const double square = p * p + q * q;
  const double height = square - slope * slope;
  if (square == 0 || height < 0) return range;
  const double phase = std::atan2(q, p);
  const double rising = slope == 0 ? 0 : std::asin(slope / std::sqrt(square));
  constexpr double kTurn = 2 * std::numbers::pi;
  const auto include_turns = [&](double turning, double wave) {
    for (double t = turning - kTurn * std::ceil(turning / kTurn); t <= end; t += kTurn)
      if (t > 0) range.include({wave + slope * t, wave + slope * t});
  };
  include_turns(phase + rising, std::sqrt(height));
  include_turns(phase + std::numbers::pi - rising, -std::sqrt(height));
  return range;
}

Range wave_range(double p, double q, double slope, double end) {
  return wave_range(p, q, slope, end, p * std::cos(end) + q * std::sin(end) + slope * end);
}

std::array<Range, 3> wave_ranges(const Vec3& center, const Vec3& p, const Vec3& q, const Vec3& slope, double end) {
  std::array<Range, 3> ranges;
  const Vec3 last = std::cos(end) * p + std::sin(end) * q + end * slope;
  for (int axis = 0; axis < 3; ++axis) {
    const Range wave = wave_range(p[axis], q[axis], slope[axis], end, last[axis]);
    ranges[static_cast<std::size_t>(axis)] = {center[axis] + wave.least, center[axis] + wave.most};
  }
  return ranges;
}

}  // namespace isocnc::geometry
