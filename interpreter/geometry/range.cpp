#include "interpreter/geometry/range.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace isocnc::geometry {

/// Between the ends it can only turn where its slope is zero: amplitude sin(t - phase) = slope.
Range wave_range(double p, double q, double slope, double end) {
  const auto value = [&](double t) { return p * std::cos(t) + q * std::sin(t) + slope * t; };
  Range range{p, p};
  const auto include = [&](double t) {
    range.least = std::min(range.least, value(t));
    range.most = std::max(range.most, value(t));
  };
  include(end);
  const double amplitude = std::hypot(p, q);
  if (amplitude == 0 || std::abs(slope) > amplitude) return range;
  const double phase = std::atan2(q, p);
  const double rising = std::asin(slope / amplitude);
  constexpr double kTurn = 2 * std::numbers::pi;
  for (const double turning : {phase + rising, phase + std::numbers::pi - rising})
    for (double t = turning - kTurn * std::ceil(turning / kTurn); t <= end; t += kTurn)
      if (t > 0) include(t);
  return range;
}

}  // namespace isocnc::geometry
