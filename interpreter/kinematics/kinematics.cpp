#include "interpreter/kinematics/kinematics.h"

#include "interpreter/geometry/frame.h"
#include "interpreter/kinematics/numbers.h"

namespace isocnc::kinematics {

using geometry::Mat3;
using geometry::Vec3;

Coordinates coordinates(const geometry::Pose& pose) {
  Coordinates result;
  result << pose.tip, pose.b, pose.c;
  return result;
}

geometry::Pose pose(const Coordinates& coordinates) {
  return {coordinates.head<3>(), coordinates[kB], coordinates[kC]};
}

/// A vector and its first two derivatives.
struct VectorJet {
  Vec3 value = Vec3::Zero();
  Vec3 first = Vec3::Zero();
  Vec3 second = Vec3::Zero();
};

/// An angle in degrees with its first two derivatives in radians.
struct AngleJet {
  double degrees = 0;
  double first = 0;
  double second = 0;
};

static AngleJet angle(const Jet& jet, MachineAxis axis) {
  return {jet.value[axis], jet.first[axis] * kRadians, jet.second[axis] * kRadians};
}

static VectorJet linear(const Jet& jet) { return {jet.value.head<3>(), jet.first.head<3>(), jet.second.head<3>()}; }

namespace {

/// A rotation about Y.
struct AboutY {
  static Vec3 turned(const geometry::SineCosine& by, const Vec3& v) {
    return {by.cosine * v.x() + by.sine * v.z(), v.y(), by.cosine * v.z() - by.sine * v.x()};
  }
  /// The cross product of the axis and a vector.
  static Vec3 across(const Vec3& v) { return {v.z(), 0, -v.x()}; }
};

/// A rotation about Z.
struct AboutZ {
  static Vec3 turned(const geometry::SineCosine& by, const Vec3& v) {
    return {by.cosine * v.x() - by.sine * v.y(), by.sine * v.x() + by.cosine * v.y(), v.z()};
  }
  static Vec3 across(const Vec3& v) { return {-v.y(), v.x(), 0}; }
};

}  // namespace

/// Rotates a vector that itself changes. The derivative is that in a rotating frame:
/// (R v)' = angle' (axis x R v) + R v'.
template <class Axis>
static VectorJet turn(const AngleJet& angle, const VectorJet& v) {
  const geometry::SineCosine by = geometry::sine_and_cosine(angle.degrees);
  const Vec3 value = Axis::turned(by, v.value);
  const Vec3 slope = Axis::turned(by, v.first);
  const Vec3 across = Axis::across(value);
  return {value, angle.first * across + slope,
          angle.second * across + angle.first * angle.first * Axis::across(across) +
              2 * angle.first * Axis::across(slope) + Axis::turned(by, v.second)};
}

static VectorJet shifted(VectorJet v, const Vec3& by) {
  v.value += by;
  return v;
}

static Vec3 tool(double length) { return {0, 0, length}; }

/// Returns the vector from the spindle nose to the B axis of a head at B = C = 0, mm.
static Vec3 arm(const Kinematics& k) { return tool(k.pivot) - k.spindle_from_b; }

static Jet with_linear(const Jet& jet, const VectorJet& linear) {
  Jet result = jet;
  result.value.head<3>() = linear.value;
  result.first.head<3>() = linear.first;
  result.second.head<3>() = linear.second;
  return result;
}

InverseAt::InverseAt(const Kinematics& kinematics, const Coordinates& tip, double tool_length)
    : kind_(kinematics.kind), joints_(tip) {
  switch (kind_) {
    case MachineKind::ThreeAxis:
      joints_[kZ] += tool_length;
      break;
    case MachineKind::Head:
      set_head(kinematics, tool_length);
      break;
    case MachineKind::Table:
      set_table(kinematics, tool_length);
      break;
  }
}

/// From the tip up to the B axis and on to the C axis as B and C have turned them, and back down as at B = C = 0.
void InverseAt::set_head(const Kinematics& k, double tool_length) {
  const geometry::SineCosine b = geometry::sine_and_cosine(joints_[kB]);
  const geometry::SineCosine c = geometry::sine_and_cosine(joints_[kC]);
  const Vec3 to_b = AboutY::turned(b, arm(k) + tool(tool_length));
  const Vec3 to_b_turning = AboutY::across(to_b);
  const Vec3 to_c = to_b - k.b_from_c;
  joints_.head<3>() += AboutZ::turned(c, to_c) + k.b_from_c - arm(k);
  by_b_ = kRadians * AboutZ::turned(c, to_b_turning);
  by_c_ = kRadians * AboutZ::turned(c, AboutZ::across(to_c));
  by_b_b_ = square(kRadians) * AboutZ::turned(c, AboutY::across(to_b_turning));
  by_b_c_ = square(kRadians) * AboutZ::turned(c, AboutZ::across(to_b_turning));
  by_c_c_ = square(kRadians) * AboutZ::turned(c, AboutZ::across(AboutZ::across(to_c)));
}

/// The table turns back what the program turns: B and C count the other way.
void InverseAt::set_table(const Kinematics& k, double tool_length) {
  const geometry::SineCosine b = geometry::sine_and_cosine(-joints_[kB]);
  const geometry::SineCosine c = geometry::sine_and_cosine(-joints_[kC]);
  const Vec3 turned = AboutZ::turned(c, joints_.head<3>() - k.c_point);
  const Vec3 tilted = AboutY::turned(b, turned + k.c_point - k.b_point);
  const Vec3 turning = AboutY::turned(b, AboutZ::across(turned));
  joints_.head<3>() = tilted + k.b_point + tool(tool_length);
  by_b_ = -kRadians * AboutY::across(tilted);
  by_c_ = -kRadians * turning;
  by_b_b_ = square(kRadians) * AboutY::across(AboutY::across(tilted));
  by_b_c_ = square(kRadians) * AboutY::across(turning);
  by_c_c_ = square(kRadians) * AboutY::turned(b, AboutZ::across(AboutZ::across(turned)));
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 direction = AboutZ::turned(c, Vec3::Unit(axis));
    by_tip_.col(axis) = AboutY::turned(b, direction);
    by_tip_b_.col(axis) = -kRadians * AboutY::across(by_tip_.col(axis));
    by_tip_c_.col(axis) = -kRadians * AboutY::turned(b, AboutZ::across(direction));
  }
}

Derivatives InverseAt::derivatives(const Derivatives& tip) const {
  Derivatives result = tip;
  if (kind_ == MachineKind::ThreeAxis) return result;
  const double b = tip.first[kB];
  const double c = tip.first[kC];
  const Vec3 slope = b * by_b_ + c * by_c_;
  const Vec3 bend =
      tip.second[kB] * by_b_ + tip.second[kC] * by_c_ + b * b * by_b_b_ + 2 * b * c * by_b_c_ + c * c * by_c_c_;
  if (kind_ == MachineKind::Head) {
    result.first.head<3>() += slope;
    result.second.head<3>() += bend;
    return result;
  }
  const Vec3 first = tip.first.head<3>();
  const Vec3 second = tip.second.head<3>();
  result.first.head<3>() = by_tip_ * first + slope;
  result.second.head<3>() = by_tip_ * second + bend + 2 * b * (by_tip_b_ * first) + 2 * c * (by_tip_c_ * first);
  return result;
}

Jet inverse(const Kinematics& kinematics, const Jet& tip, double tool_length) {
  const InverseAt at(kinematics, tip.value, tool_length);
  const Derivatives joints = at.derivatives(tip.derivatives());
  return {at.joints(), joints.first, joints.second};
}

/// Of a table: undoes the tilt, then the turn.
static VectorJet tip_on_table(const Kinematics& k, const Jet& joints, double tool_length) {
  const VectorJet nose = shifted(linear(joints), -(k.b_point + tool(tool_length)));
  const VectorJet tilted = turn<AboutY>(angle(joints, kB), nose);
  return shifted(turn<AboutZ>(angle(joints, kC), shifted(tilted, k.b_point - k.c_point)), k.c_point);
}

Jet forward(const Kinematics& k, const Jet& joints, double tool_length) {
  if (k.kind == MachineKind::Table) return with_linear(joints, tip_on_table(k, joints, tool_length));
  // Elsewhere the joints are the tip and what B and C add to it.
  const Jet added = inverse(k, with_linear(joints, {}), tool_length);
  return with_linear(joints,
                     {joints.value.head<3>() - added.value.head<3>(), joints.first.head<3>() - added.first.head<3>(),
                      joints.second.head<3>() - added.second.head<3>()});
}

Coordinates inverse(const Kinematics& kinematics, const Coordinates& tip, double tool_length) {
  return InverseAt(kinematics, tip, tool_length).joints();
}

Coordinates forward(const Kinematics& kinematics, const Coordinates& joints, double tool_length) {
  return forward(kinematics, Jet{.value = joints}, tool_length).value;
}

Mat3 turn_to_joints(const Kinematics& kinematics, double b_deg, double c_deg) {
  if (kinematics.kind != MachineKind::Table) return Mat3::Identity();
  return geometry::axes_from_angles(-b_deg, 0) * geometry::axes_from_angles(0, -c_deg);
}

double lever(const Kinematics& k, const Vec3& tip, double tool_length) {
  switch (k.kind) {
    case MachineKind::ThreeAxis:
      return 0;
    case MachineKind::Head:
      return k.b_from_c.norm() + (arm(k) + tool(tool_length)).norm();
    case MachineKind::Table:
      return (tip - k.c_point).norm() + 2 * (k.c_point - k.b_point).norm();
  }
  return 0;
}

}  // namespace isocnc::kinematics
