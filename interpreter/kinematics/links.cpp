#include "interpreter/kinematics/links.h"

#include "interpreter/geometry/frame.h"

namespace isocnc::kinematics {

using Eigen::Isometry3d;
using geometry::Vec3;

static Isometry3d shift(const Vec3& by) {
  Isometry3d result = Isometry3d::Identity();
  result.translation() = by;
  return result;
}

static Isometry3d turn(double b_deg, double c_deg, const Vec3& about) {
  Isometry3d result = Isometry3d::Identity();
  result.linear() = geometry::axes_from_angles(b_deg, c_deg);
  result.translation() = about - result.linear() * about;
  return result;
}

/// On a head: C turns about the C axis, then B about the B axis that C has turned.
static Isometry3d head_pose(const Kinematics& k, Link link, const Coordinates& joints) {
  const Vec3 b_axis = Vec3(0, 0, k.pivot) - k.spindle_from_b;  // With all joints at 0.
  const Vec3 c_axis = b_axis - k.b_from_c;
  const Isometry3d carried = shift(joints.head<3>()) * turn(0, joints[kC], c_axis);
  return link == Link::C ? carried : carried * turn(joints[kB], 0, b_axis);
}

static Isometry3d table_pose(const Kinematics& k, Link link, const Coordinates& joints) {
  const Isometry3d cradle = turn(-joints[kB], 0, k.b_point);
  return link == Link::B ? cradle : cradle * turn(0, -joints[kC], k.c_point);
}

Isometry3d link_pose(const Kinematics& kinematics, Link link, const Coordinates& joints) {
  switch (link) {
    case Link::Machine:
      return Isometry3d::Identity();
    case Link::X:
      return shift({joints[kX], 0, 0});
    case Link::Y:
      return shift({joints[kX], joints[kY], 0});
    case Link::Z:
      return shift(joints.head<3>());
    case Link::C:
    case Link::B:
      break;
  }
  switch (kinematics.kind) {
    case MachineKind::ThreeAxis:
      return shift(joints.head<3>());
    case MachineKind::Head:
      return head_pose(kinematics, link, joints);
    case MachineKind::Table:
      break;
  }
  return table_pose(kinematics, link, joints);
}

Link spindle_link(const Kinematics& kinematics) { return kinematics.kind == MachineKind::Head ? Link::B : Link::Z; }

Link workpiece_link(const Kinematics& kinematics) {
  return kinematics.kind == MachineKind::Table ? Link::C : Link::Machine;
}

geometry::Vec3 point_on_link(const Kinematics& kinematics, Link in, Link of, const Coordinates& joints,
                             const geometry::Vec3& point) {
  return link_pose(kinematics, in, joints).inverse() * (link_pose(kinematics, of, joints) * point);
}

}  // namespace isocnc::kinematics
