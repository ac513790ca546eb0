#include "interpreter/geometry/frame.h"

#include <cmath>
#include <numbers>

#include <Eigen/LU>

namespace isocnc::geometry {

Vec3 Frame::to_inner(const Vec3& p) const { return axes.inverse() * (p - origin); }

bool has_direction(const Vec3& vector) { return vector.norm() >= kZeroVector; }

bool are_coplanar(const Mat3& unit_axes) { return std::abs(unit_axes.determinant()) < kZeroVector; }

SineCosine sine_and_cosine(double degrees) {
  const double quarters = degrees / 90;
  if (quarters == std::floor(quarters) && std::abs(quarters) < 1e9) {
    static constexpr double kSines[] = {0, 1, 0, -1};
    const int quarter = static_cast<int>(((static_cast<long long>(quarters) % 4) + 4) % 4);
    return {.sine = kSines[quarter], .cosine = kSines[(quarter + 1) % 4]};
  }
  const double radians = degrees * std::numbers::pi / 180;
  return {.sine = std::sin(radians), .cosine = std::cos(radians)};
}

Mat3 axes_from_angles(double b_deg, double c_deg) {
  const auto [sin_b, cos_b] = sine_and_cosine(b_deg);
  const auto [sin_c, cos_c] = sine_and_cosine(c_deg);
  Mat3 axes;
  axes.col(0) = Vec3(cos_c * cos_b, sin_c * cos_b, -sin_b);
  axes.col(1) = Vec3(-sin_c, cos_c, 0);
  axes.col(2) = Vec3(cos_c * sin_b, sin_c * sin_b, cos_b);
  return axes;
}

}  // namespace isocnc::geometry
