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

static AngleJet angle(const Jet& jet, MachineAxis axis, double sense) {
  return {sense * jet.value[axis], sense * jet.first[axis] * kRadians, sense * jet.second[axis] * kRadians};
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

static VectorJet turn_about_z(const AngleJet& c, const VectorJet& v) { return turn<AboutZ>(c, v); }

static VectorJet turn_about_y(const AngleJet& b, const VectorJet& v) { return turn<AboutY>(b, v); }

static VectorJet shifted(VectorJet v, const Vec3& by) {
  v.value += by;
  return v;
}

static Vec3 tool(double length) { return {0, 0, length}; }

/// Returns the vector from the spindle nose to the B axis of a head at B = C = 0, mm.
static Vec3 arm(const Kinematics& k) { return tool(k.pivot) - k.spindle_from_b; }

/// Returns the vector of a head from the tip to the position of the spindle nose at B = C = 0, mm. It depends on B and
/// C alone: from the tip up to the B axis and on to the C axis as B and C have turned them, and back down as at B = C =
/// 0.
static VectorJet head_reach(const Kinematics& k, const Jet& jet, double tool_length) {
  const VectorJet to_b = turn_about_y(angle(jet, kB, 1), {.value = arm(k) + tool(tool_length)});
  return shifted(turn_about_z(angle(jet, kC, 1), shifted(to_b, -k.b_from_c)), k.b_from_c - arm(k));
}

static Jet with_linear(const Jet& jet, const VectorJet& linear) {
  Jet result = jet;
  result.value.head<3>() = linear.value;
  result.first.head<3>() = linear.first;
  result.second.head<3>() = linear.second;
  return result;
}

static VectorJet sum(const VectorJet& a, const VectorJet& b, double sign) {
  return {a.value + sign * b.value, a.first + sign * b.first, a.second + sign * b.second};
}

Jet inverse(const Kinematics& k, const Jet& tip, double tool_length) {
  switch (k.kind) {
    case MachineKind::ThreeAxis:
      return with_linear(tip, shifted(linear(tip), tool(tool_length)));
    case MachineKind::Head:
      return with_linear(tip, sum(linear(tip), head_reach(k, tip, tool_length), 1));
    case MachineKind::Table:
      break;
  }
  const VectorJet turned = turn_about_z(angle(tip, kC, -1), shifted(linear(tip), -k.c_point));
  const VectorJet tilted = turn_about_y(angle(tip, kB, -1), shifted(turned, k.c_point - k.b_point));
  return with_linear(tip, shifted(tilted, k.b_point + tool(tool_length)));
}

Jet forward(const Kinematics& k, const Jet& joints, double tool_length) {
  switch (k.kind) {
    case MachineKind::ThreeAxis:
      return with_linear(joints, shifted(linear(joints), -tool(tool_length)));
    case MachineKind::Head:
      return with_linear(joints, sum(linear(joints), head_reach(k, joints, tool_length), -1));
    case MachineKind::Table:
      break;
  }
  const VectorJet nose = shifted(linear(joints), -(k.b_point + tool(tool_length)));
  const VectorJet tilted = turn_about_y(angle(joints, kB, 1), nose);
  return with_linear(joints,
                     shifted(turn_about_z(angle(joints, kC, 1), shifted(tilted, k.b_point - k.c_point)), k.c_point));
}

Coordinates inverse(const Kinematics& kinematics, const Coordinates& tip, double tool_length) {
  return inverse(kinematics, Jet{.value = tip}, tool_length).value;
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
