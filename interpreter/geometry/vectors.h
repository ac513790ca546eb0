#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>  // cross()

namespace isocnc::geometry {

/// Positions and directions in mm, in the frame given by the name or the comment.
using Vec3 = Eigen::Vector3d;
using Vec2 = Eigen::Vector2d;  ///< In a plane.
using Mat3 = Eigen::Matrix3d;

/// A position of the tool tip with the rotary axes: X Y Z in mm in some frame, B C in degrees. B and C are machine
/// positions in every frame (D30).
struct Pose {
  Vec3 tip = Vec3::Zero();
  double b = 0;
  double c = 0;

  friend bool operator==(const Pose& left, const Pose& right) {
    return left.tip == right.tip && left.b == right.b && left.c == right.c;
  }
};

}  // namespace isocnc::geometry
