#include "interpreter/verification/motion_bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "interpreter/geometry/cubic.h"
#include "interpreter/kinematics/numbers.h"

namespace isocnc::verification {

using geometry::Vec3;
using kinematics::MachineKind;
using kinematics::Path;
using kinematics::PathKind;

/// A bound of the norm of the derivative of some of a path's coordinates, from the `first` one on.
template <int count>
static double slope_bound(const Path& path, int first, double from, double to) {
  const auto c = [&](std::size_t i) { return path.c[i].template segment<count>(first); };
  if (path.kind == PathKind::Polynomial) {
    if (path.c[2].isZero(0) && path.c[3].isZero(0)) return c(1).norm();
    // The second derivative changes linearly, so its norm is largest at an end.
    const double middle = (from + to) / 2;
    const auto second = [&](double s) { return (2 * c(2) + 6 * s * c(3)).norm(); };
    return (c(1) + middle * (2 * c(2) + 3 * middle * c(3))).norm() +
           std::abs(to - from) / 2 * std::max(second(from), second(to));
  }
  // The longer half axis of the ellipse that c1 cos + c2 sin describes.
  const double mean = (c(1).squaredNorm() + c(2).squaredNorm()) / 2;
  const double difference = (c(1).squaredNorm() - c(2).squaredNorm()) / 2;
  const double around = std::abs(path.omega) * std::sqrt(mean + std::hypot(difference, c(1).dot(c(2))));
  const double across = std::hypot(c(1).dot(c(3)), c(2).dot(c(3)));
  const bool is_helix = across <= 1e-9 * (1 + mean);
  return is_helix ? std::hypot(around, c(3).norm()) * (1 + 1e-9) : around + c(3).norm();
}

/// The maximum of a cos(t) + b sin(t).
static double highest_of_circle(double a, double b, double from, double to) {
  const double last = std::max(from, to);
  const double first = std::min(from, to);
  constexpr double kTurn = 2 * std::numbers::pi;
  const double top = std::atan2(b, a);
  const double next_top = top + kTurn * std::ceil((first - top) / kTurn);
  if (next_top <= last) return std::hypot(a, b);
  const auto at = [&](double t) { return a * std::cos(t) + b * std::sin(t); };
  return std::max(at(first), at(last));
}

double highest_along(const Path& path, const Vec3& n, double from, double to) {
  std::array<double, 4> c;
  for (std::size_t i = 0; i < c.size(); ++i) c[i] = n.dot(path.c[i].head<3>());
  if (path.kind == PathKind::Polynomial) return geometry::cubic_range(c, from, to).maximum;
  return c[0] + highest_of_circle(c[1], c[2], path.omega * from, path.omega * to) + std::max(c[3] * from, c[3] * to);
}

/// A bound of the distance from the spindle nose to the axes of a table.
static double swing(const kinematics::Kinematics& k, const Vec3& nose) {
  return (nose - k.b_point).norm() + (k.b_point - k.c_point).norm();
}

MotionBounds motion_bounds(const kinematics::Kinematics& k, const Path& path, double from, double to) {
  const double linear = slope_bound<3>(path, kinematics::kX, from, to);
  MotionBounds bounds{.tip = linear, .joints = linear};
  if (k.kind == MachineKind::ThreeAxis) return bounds;
  bounds.turn = slope_bound<2>(path, kinematics::kB, from, to) * kinematics::kRadians;
  const double middle = (from + to) / 2;
  const double half = std::abs(to - from) / 2;
  if (k.kind == MachineKind::Head) {
    if (bounds.turn > 0) {
      const double lever = kinematics::lever(k, Vec3::Zero(), path.tool_length);
      (path.is_of_joints ? bounds.tip : bounds.joints) += bounds.turn * lever;
    }
    return bounds;
  }
  const Vec3 joints = path.joints_at(k, middle).value.head<3>();
  const Vec3 tool(0, 0, path.tool_length);
  if (path.is_of_joints) {
    bounds.tip += bounds.turn * (swing(k, joints - tool) + half * bounds.joints);
  } else if (bounds.turn > 0) {
    const Vec3 tip = path.tip_at(k, middle).value.head<3>();
    bounds.joints += bounds.turn * (kinematics::lever(k, tip, path.tool_length) + half * bounds.tip);
  }
  bounds.swing = swing(k, joints) + half * bounds.joints;
  return bounds;
}

}  // namespace isocnc::verification
