#include "interpreter/geometry/frame.h"

#include <cmath>
#include <numbers>

#include <Eigen/LU>

namespace isocnc::geometry {

Vec3 Frame::to_inner(const Vec3& p) const { return axes.inverse() * (p - origin); }

bool has_direction(const Vec3& vector) { return vector.norm() >= kZeroVector; }

bool are_coplanar(const Mat3& unit_axes) { return std::abs(unit_axes.determinant()) < kZeroVector; }

/// Returns a polynomial of z by Horner's scheme, the highest coefficient first.
template <std::size_t kCount>
static double polynomial(const double (&coefficients)[kCount], double z) {
  double sum = coefficients[0];
  for (std::size_t i = 1; i < kCount; ++i) sum = sum * z + coefficients[i];
  return sum;
}

/// The Taylor series of sine and cosine at 45 degrees at most, where what is left out is below half the last digit. The
/// library's functions take more than twice as long, and differ from platform to platform.
static SineCosine near_zero(double radians) {
  static constexpr double kSine[] = {1 / 355687428096000.0, -1 / 1307674368000.0, 1 / 6227020800.0, -1 / 39916800.0,
                                     1 / 362880.0,          -1 / 5040.0,          1 / 120.0,        -1 / 6.0};
  static constexpr double kCosine[] = {1 / 20922789888000.0, -1 / 87178291200.0, 1 / 479001600.0, -1 / 3628800.0,
                                       1 / 40320.0,          -1 / 720.0,         1 / 24.0,        -1 / 2.0};
  const double z = radians * radians;
  return {.sine = radians + radians * z * polynomial(kSine, z), .cosine = 1 + z * polynomial(kCosine, z)};
}

SineCosine sine_and_cosine(double degrees) {
  static constexpr double kMaxDegrees = 1e9;
  if (!(std::abs(degrees) < kMaxDegrees)) {
    const double radians = degrees * std::numbers::pi / 180;
    return {.sine = std::sin(radians), .cosine = std::cos(radians)};
  }
  // The quarter turns are subtracted without an error of rounding.
  const auto quarters = static_cast<long long>(degrees * (1 / 90.0) + (degrees < 0 ? -0.5 : 0.5));
  const auto [sine, cosine] = near_zero((degrees - 90 * static_cast<double>(quarters)) * (std::numbers::pi / 180));
  switch (quarters & 3) {  // 0 + and 0 -, for no zero to have a sign.
    case 0:
      return {.sine = 0 + sine, .cosine = cosine};
    case 1:
      return {.sine = cosine, .cosine = 0 - sine};
    case 2:
      return {.sine = 0 - sine, .cosine = -cosine};
    default:
      return {.sine = -cosine, .cosine = 0 + sine};
  }
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
