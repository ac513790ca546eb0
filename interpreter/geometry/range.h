#pragma once

namespace isocnc::geometry {

struct Range {
  double least = 0;
  double most = 0;
};

/// Least and most of p cos t + q sin t + slope t for t from 0 to `end`, radians, not negative.
Range wave_range(double p, double q, double slope, double end);

}  // namespace isocnc::geometry
