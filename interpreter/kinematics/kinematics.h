#pragma once

#include <Eigen/Core>

#include "interpreter/geometry/vectors.h"
#include "interpreter/kinematics/machine.h"

namespace isocnc::kinematics {

/// X, Y, Z in mm and B, C in degrees: positions of the joints, or a pose of the tip in the machine frame.
using Coordinates = Eigen::Matrix<double, kAxisCount, 1>;

Coordinates coordinates(const geometry::Pose& pose);
geometry::Pose pose(const Coordinates& coordinates);

/// Inverse kinematics: returns the positions of the joints that hold the tip of a tool of `tool_length` mm at `tip`.
/// There is one answer for each pose, since the pose contains B and C.
Coordinates inverse(const Kinematics& kinematics, const Coordinates& tip, double tool_length);

/// Forward kinematics: returns the pose of the tip for given positions of the joints. The function undoes inverse().
Coordinates forward(const Kinematics& kinematics, const Coordinates& joints, double tool_length);

/// The first two derivatives by the path parameter.
struct Derivatives {
  Coordinates first = Coordinates::Zero();
  Coordinates second = Coordinates::Zero();
};

/// A value and its first two derivatives by the path parameter.
struct Jet {
  Coordinates value = Coordinates::Zero();
  Coordinates first = Coordinates::Zero();
  Coordinates second = Coordinates::Zero();

  Derivatives derivatives() const { return {first, second}; }
};

/// Applies inverse() along a path, with derivatives by the chain rule.
Jet inverse(const Kinematics& kinematics, const Jet& tip, double tool_length);

/// Applies forward() along a path, with derivatives by the chain rule.
Jet forward(const Kinematics& kinematics, const Jet& joints, double tool_length);

/// Inverse kinematics at one pose of the tip. Several paths through it share what depends on the pose alone.
class InverseAt {
 public:
  InverseAt(const Kinematics& kinematics, const Coordinates& tip, double tool_length);

  /// Returns the positions of the joints.
  const Coordinates& joints() const { return joints_; }
  /// Returns the derivatives of the joints along a path of the tip with these derivatives at the pose.
  Derivatives derivatives(const Derivatives& tip) const;

 private:
  void set_head(const Kinematics& kinematics, double tool_length);
  void set_table(const Kinematics& kinematics, double tool_length);

  MachineKind kind_;
  Coordinates joints_;
  /// Partial derivatives of X, Y, Z by B and C, mm and mm^2 for a degree.
  geometry::Vec3 by_b_;
  geometry::Vec3 by_c_;
  geometry::Vec3 by_b_b_;
  geometry::Vec3 by_b_c_;
  geometry::Vec3 by_c_c_;
  /// Of a table: partial derivatives of X, Y, Z by the tip, and of these by B and C.
  geometry::Mat3 by_tip_;
  geometry::Mat3 by_tip_b_;
  geometry::Mat3 by_tip_c_;
};

/// Returns the rotation that turns a direction of the tip into that of the joints X, Y, Z while B and C rest.
geometry::Mat3 turn_to_joints(const Kinematics& kinematics, double b_deg, double c_deg);

/// Returns an upper bound, in mm, of the distance between the rotary axes and the tip (of the tool or the workpiece): a
/// linear joint moves at most this far for one radian of B or C.
double lever(const Kinematics& kinematics, const geometry::Vec3& tip, double tool_length);

}  // namespace isocnc::kinematics
