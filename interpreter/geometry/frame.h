#pragma once

#include "interpreter/geometry/vectors.h"

namespace isocnc::geometry {

/// Length below which an axis vector has no direction, and volume below which three unit vectors are coplanar (D26).
inline constexpr double kZeroVector = 1e-6;
/// Two axes are orthogonal when the cosine between them is below this. CAM systems write few decimals (D26).
inline constexpr double kOrthogonalCosine = 1e-3;

/// A frame, described in an outer frame. Its unit axes may be oblique or left-handed (D26).
/// P = origin + x i + y j + z k.
struct Frame {
  Vec3 origin = Vec3::Zero();
  Mat3 axes = Mat3::Identity();  ///< Columns i, j, k.

  Vec3 to_outer(const Vec3& p) const { return origin + axes * p; }
  Vec3 to_inner(const Vec3& p) const;

  friend bool operator==(const Frame& a, const Frame& b) { return a.origin == b.origin && a.axes == b.axes; }
};

/// Whether an axis vector is long enough to give a direction.
bool has_direction(const Vec3& vector);

/// Whether three unit vectors lie in a plane (kZeroVector).
bool are_coplanar(const Mat3& unit_axes);

/// Sine and cosine of an angle.
struct SineCosine {
  double sine = 0;
  double cosine = 1;
};

/// Of an angle in degrees, exact at the quarter turns: a face at B90 has no 6e-17 in its axes.
SineCosine sine_and_cosine(double degrees);

/// Axes of G29 (D28): i = Rz(C) Ry(B) ex, j = Rz(C) ey, k = Rz(C) Ry(B) ez; angles in degrees.
Mat3 axes_from_angles(double b_deg, double c_deg);

}  // namespace isocnc::geometry
