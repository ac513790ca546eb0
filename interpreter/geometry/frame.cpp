#include "interpreter/geometry/frame.h"

#include <cmath>
#include <numbers>

#include <Eigen/LU>

namespace isocnc::geometry {

Vec3 Frame::to_inner(const Vec3& p) const { return axes.inverse() * (p - origin); }

bool has_direction(const Vec3& vector) { return vector.norm() >= kZeroVector; }

bool are_coplanar(const Mat3& unit_axes) { return std::abs(unit_axes.determinant()) < kZeroVector; }

/// Sine and cosine in degrees, exact at the quarter turns: a face at B90 has no 6e-17 in its axes.
static void sin_cos_deg(double degrees, double& sine, double& cosine) {
  const double quarters = degrees / 90;
  if (quarters == std::floor(quarters) && std::abs(quarters) < 1e9) {
    static constexpr double kSines[] = {0, 1, 0, -1};
    const int quarter = static_cast<int>(((static_cast<long long>(quarters) % 4) + 4) % 4);
    sine = kSines[quarter];
    cosine = kSines[(quarter + 1) % 4];
    return;
  }
  sine = std::sin(degrees * std::numbers::pi / 180);
  cosine = std::cos(degrees * std::numbers::pi / 180);
}

Mat3 axes_from_angles(double b_deg, double c_deg) {
  double sin_b;
  double cos_b;
  double sin_c;
  double cos_c;
  sin_cos_deg(b_deg, sin_b, cos_b);
  sin_cos_deg(c_deg, sin_c, cos_c);
  Mat3 axes;
  axes.col(0) = Vec3(cos_c * cos_b, sin_c * cos_b, -sin_b);
  axes.col(1) = Vec3(-sin_c, cos_c, 0);
  axes.col(2) = Vec3(cos_c * sin_b, sin_c * sin_b, cos_b);
  return axes;
}

}  // namespace isocnc::geometry
