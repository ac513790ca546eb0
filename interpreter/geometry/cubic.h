#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "interpreter/geometry/range.h"

namespace isocnc::geometry {

/// Returns the minimum and the maximum of c0 + c1 s + c2 s^2 + c3 s^3 between two values of s.
inline Range cubic_range(const std::array<double, 4>& c, double from, double to) {
  const auto at = [&](double s) { return c[0] + s * (c[1] + s * (c[2] + s * c[3])); };
  Range range{std::min(at(from), at(to)), std::max(at(from), at(to))};
  const auto look_at = [&](double s) {
    if (s > from && s < to) range.include({at(s), at(s)});
  };
  // Where the derivative c1 + 2 c2 s + 3 c3 s^2 is 0, in the form that cancels nothing.
  const double discriminant = c[2] * c[2] - 3 * c[1] * c[3];
  if (!(discriminant >= 0)) return range;
  const double q = -(c[2] + std::copysign(std::sqrt(discriminant), c[2]));
  if (c[3] != 0) look_at(q / (3 * c[3]));
  if (q != 0) look_at(c[1] / q);
  return range;
}

}  // namespace isocnc::geometry
