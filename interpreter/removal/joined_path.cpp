#include "interpreter/removal/joined_path.h"

#include <algorithm>
#include <cmath>

namespace isocnc::removal {

using geometry::Vec3;
using solids::AxisPlacement;

/// A piece turns the axis by less, radians.
static constexpr double kMostTurn = 0.5;

static AxisPlacement placement_at_end(const stock::SweepPath& path) {
  if (const auto* const turning = std::get_if<stock::TurningPath>(&path)) return turning->to;
  return {end_of(path), axis_of(path)};
}

/// Directions of an axis at rest differ by less, radians.
static constexpr double kRounding = 1e-12;

/// An upper bound of the angle between two unit vectors that are less than a radian apart.
static double turn_between(const Vec3& one, const Vec3& other) { return 1.05 * (other - one).norm(); }

JoinedPath::JoinedPath(const TipPath& first) : path_(first.path) {
  nodes_[0] = start_of(first.path);
  nodes_[1] = placement_at_end(first.path);
  greatest_ = greatest_of(first, turn_between(nodes_[0].axis, nodes_[1].axis));
}

JoinedPath::Greatest JoinedPath::greatest_of(const TipPath& piece, double turn) {
  return {.reach = piece.reach,
          .stray = piece.stray,
          .stray_in_height = piece.stray_in_height,
          .stray_of_axis = piece.stray_of_axis,
          .turn = turn};
}

JoinedPath::Greatest JoinedPath::of_both(const Greatest& one, const Greatest& other) {
  return {.reach = std::max(one.reach, other.reach),
          .stray = std::max(one.stray, other.stray),
          .stray_in_height = std::max(one.stray_in_height, other.stray_in_height),
          .stray_of_axis = std::max(one.stray_of_axis, other.stray_of_axis),
          .turn = std::max(one.turn, other.turn)};
}

bool JoinedPath::add(const TipPath& next, const Tolerance& tolerance) {
  // Of a line at rest it is not known how far up the tool matters while the axis turns.
  const bool is_alike = next.path.index() == path_.index() && !std::holds_alternative<stock::HelixPath>(path_);
  if (!is_alike || count_ == kMostNodes) return false;
  const AxisPlacement& start = nodes_.front();
  const AxisPlacement end = placement_at_end(next.path);
  const Greatest greatest = of_both(greatest_, greatest_of(next, turn_between(nodes().back().axis, end.axis)));
  if (std::holds_alternative<stock::StraightPath>(path_)) {
    if (greatest.turn > kRounding || !strays_little_at_rest(end, greatest, tolerance)) return false;
    path_ = stock::StraightPath{start, end.origin};
  } else {
    if (!strays_little(end, greatest, tolerance)) return false;
    path_ = stock::TurningPath{start, end};
  }
  nodes_[count_++] = end;
  greatest_ = greatest;
  return true;
}

/// How far along the line from one point to another the foot of a third is, from 0 to 1.
static double share_along(const Vec3& from, const Vec3& to, const Vec3& point) {
  const Vec3 way = to - from;
  const double square = way.squaredNorm();
  return square > 0 ? std::clamp(way.dot(point - from) / square, 0.0, 1.0) : 0.0;
}

/// The pieces lie between their ends, and a line is nowhere farther from another one than at an end: so what the ends
/// stray, and what a piece does of its own path, is all that a point strays.
bool JoinedPath::strays_little_at_rest(const AxisPlacement& end, const Greatest& greatest,
                                       const Tolerance& tolerance) const {
  const AxisPlacement& start = nodes_.front();
  double aside = 0;
  double in_height = 0;
  for (const AxisPlacement& node : nodes()) {
    const double share = share_along(start.origin, end.origin, node.origin);
    const Vec3 off = node.origin - (start.origin + share * (end.origin - start.origin));
    aside = std::max(aside, off.norm());
    in_height = std::max(in_height, std::abs(off.z()));
  }
  aside += greatest.stray;
  // A tilted body that is aside is higher or lower there.
  in_height = start.axis.head<2>().isZero(0) ? in_height + greatest.stray_in_height : aside;
  return aside <= tolerance.aside && in_height <= tolerance.in_height;
}

/// The same for points at a reach above the tip. The axis turns evenly, which is not quite along the line between two
/// directions: by at most an eighth of the square of the angle, of all pieces and of each.
bool JoinedPath::strays_little(const AxisPlacement& end, const Greatest& greatest, const Tolerance& tolerance) const {
  const AxisPlacement& start = nodes_.front();
  const double turn = std::max(greatest.turn, turn_between(start.axis, end.axis));
  if (!(turn < kMostTurn)) return false;
  const double bulge = greatest.reach * turn * turn / 4;
  double most = 0;
  const bool is_moving = (end.origin - start.origin).squaredNorm() > 1e-18;
  for (const AxisPlacement& node : nodes()) {
    const double share =
        is_moving ? share_along(start.origin, end.origin, node.origin) : share_along(start.axis, end.axis, node.axis);
    const Vec3 off = node.origin - (start.origin + share * (end.origin - start.origin));
    const Vec3 turned = node.axis - (start.axis + share * (end.axis - start.axis));
    most = std::max(most, off.norm() + greatest.reach * turned.norm());
  }
  return most + bulge + greatest.stray + greatest.reach * greatest.stray_of_axis <= tolerance.aside;
}

}  // namespace isocnc::removal
