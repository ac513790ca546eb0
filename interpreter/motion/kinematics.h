#pragma once

#include <Eigen/Core>

#include "interpreter/geometry/vectors.h"
#include "interpreter/motion/machine.h"

namespace isocnc::motion {

/// X Y Z in mm, B C in degrees: of the joints, or of a pose of the tip in the machine frame.
using Coordinates = Eigen::Matrix<double, kAxisCount, 1>;

Coordinates coordinates(const geometry::Pose& pose);
geometry::Pose pose(const Coordinates& coordinates);

/// The joints that hold the tip of a tool of this length at `tip`. One answer for each pose: B and C are given.
Coordinates inverse(const Kinematics& kinematics, const Coordinates& tip, double tool_length);

/// The pose of the tip that the joints hold; undoes inverse().
Coordinates forward(const Kinematics& kinematics, const Coordinates& joints, double tool_length);

/// A value and its first two derivatives along a path.
struct Jet {
  Coordinates value = Coordinates::Zero();
  Coordinates first = Coordinates::Zero();
  Coordinates second = Coordinates::Zero();
};

/// inverse() along a path, by the chain rule.
Jet inverse(const Kinematics& kinematics, const Jet& tip, double tool_length);

/// forward() along a path, by the chain rule.
Jet forward(const Kinematics& kinematics, const Jet& joints, double tool_length);

/// Turns a direction of the tip into that of the joints while B and C rest.
geometry::Mat3 turn_to_joints(const Kinematics& kinematics, double b_deg, double c_deg);

/// How far the tip, the tool or the workpiece is from the rotary axes, at most: by so much a linear joint moves for a
/// radian of B or C. mm.
double lever(const Kinematics& kinematics, const geometry::Vec3& tip, double tool_length);

}  // namespace isocnc::motion
