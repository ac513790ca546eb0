#pragma once

#include <array>
#include <cstdint>

#include "interpreter/motion/kinematics.h"

namespace isocnc::motion {

enum class PathKind : std::uint8_t { Polynomial, Circle };

/// A curve over its parameter s, of joints or of the pose of the tip. s is the length of the tip's path in mm, or the
/// angle where B and C alone turn: exactly so on lines and arcs, nearly so where a corner is rounded.
///
/// Polynomial: c0 + c1 s + c2 s^2 + c3 s^3. Circle: c0 + c1 cos(omega s) + c2 sin(omega s) + c3 s.
struct Path {
  PathKind kind = PathKind::Polynomial;
  bool is_of_joints = false;  ///< Else of the tip.
  std::array<Coordinates, 4> c = {Coordinates::Zero(), Coordinates::Zero(), Coordinates::Zero(), Coordinates::Zero()};
  double omega = 0;  ///< rad per unit of s.
  double tool_length = 0;

  /// Of what the path is a curve of.
  Jet at(double s) const;
  Jet tip_at(const Kinematics& kinematics, double s) const;
  Jet joints_at(const Kinematics& kinematics, double s) const;

  /// Whether the path is straight: no square, no cube, no circle.
  static Path line(const Coordinates& from, const Coordinates& slope);
};

/// Upper bounds of the third and fourth derivatives of each linear joint along a path.
struct HigherDerivativeBounds {
  geometry::Vec3 third = geometry::Vec3::Zero();
  geometry::Vec3 fourth = geometry::Vec3::Zero();
};

/// For s from `from` to `to`. B and C may change up to cubically.
HigherDerivativeBounds higher_derivative_bounds(const Kinematics& kinematics, const Path& path, double from, double to);

}  // namespace isocnc::motion
