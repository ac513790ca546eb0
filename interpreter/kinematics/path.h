#pragma once

#include <array>
#include <cstdint>

#include "interpreter/kinematics/kinematics.h"

namespace isocnc::kinematics {

enum class PathKind : std::uint8_t { Polynomial, Circle };

/// A curve of the joints or of the pose of the tip, as a function of the path parameter s. s is the length of the tip's
/// path in mm, or the angle in degrees where B and C alone move. This is exact on lines and arcs, and approximate on
/// blends.
///
/// A polynomial is c0 + c1 s + c2 s^2 + c3 s^3, a circle c0 + c1 cos(omega s) + c2 sin(omega s) + c3 s.
struct Path {
  PathKind kind = PathKind::Polynomial;
  bool is_of_joints = false;  ///< Whether the curve is one of the joints; otherwise it is one of the tip.
  std::array<Coordinates, 4> c = {Coordinates::Zero(), Coordinates::Zero(), Coordinates::Zero(), Coordinates::Zero()};
  double omega = 0;        ///< Angle of a circle per unit of s, radians.
  double tool_length = 0;  ///< Distance from the spindle nose to the tip, mm.

  /// Evaluates the curve itself: joints or tip, depending on `is_of_joints`.
  Jet at(double s) const;
  Coordinates value_at(double s) const;  ///< at(s).value.
  Jet tip_at(const Kinematics& kinematics, double s) const;
  Jet joints_at(const Kinematics& kinematics, double s) const;

  /// Returns the line with this start and this first derivative by s.
  static Path line(const Coordinates& from, const Coordinates& slope);
};

/// Upper bounds of the absolute values of the linear joints' third and fourth derivatives by s.
struct HigherDerivativeBounds {
  geometry::Vec3 third = geometry::Vec3::Zero();
  geometry::Vec3 fourth = geometry::Vec3::Zero();
};

/// Returns bounds that hold for s from `from` to `to`. B and C may be polynomials of s up to the third degree.
HigherDerivativeBounds higher_derivative_bounds(const Kinematics& kinematics, const Path& path, double from, double to);

}  // namespace isocnc::kinematics
