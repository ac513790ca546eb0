#pragma once

#include <array>

#include "interpreter/geometry/vectors.h"

namespace isocnc::geometry {

struct Range {
  double minimum = 0;
  double maximum = 0;

  void include(const Range& other);
};

/// Minimum and maximum of p cos t + q sin t + slope t for t from 0 to `end`, radians, not negative.
Range wave_range(double p, double q, double slope, double end);

/// An angle in radians, not negative, with its cosine and sine, so that they are computed only once.
struct Turn {
  double angle = 0;
  double cosine = 1;
  double sine = 0;
};
Turn turn_of(double angle);

/// Minimum and maximum of each coordinate of center + p cos t + q sin t + slope t, for t from 0 to `end`.
std::array<Range, 3> wave_ranges(const Vec3& center, const Vec3& p, const Vec3& q, const Vec3& slope, const Turn& end);

}  // namespace isocnc::geometry
