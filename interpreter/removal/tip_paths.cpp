#include "interpreter/removal/tip_paths.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "interpreter/geometry/frame.h"
#include "interpreter/kinematics/numbers.h"

namespace isocnc::removal {

using geometry::Vec3;
using kinematics::Kinematics;
using kinematics::MachineKind;
using kinematics::Path;
using kinematics::PathKind;
using solids::AxisPlacement;

/// More pieces stand for a stretch in no case: a motion that needs them would take the machine hours.
static constexpr double kMaxPieces = 20'000;
/// An axis turns by less than half a turn in one piece, radians.
static constexpr double kMaxTurn = 1;

bool turns_axis(const Kinematics& kinematics, const Path& path) {
  return kinematics.kind != MachineKind::ThreeAxis &&
         std::any_of(path.c.begin() + 1, path.c.end(),
                     [](const kinematics::Coordinates& c) { return c[kinematics::kB] != 0 || c[kinematics::kC] != 0; });
}

bool is_rounded_corner(const Path& path) {
  return path.kind == PathKind::Polynomial && !(path.c[2].isZero(0) && path.c[3].isZero(0));
}

namespace {

/// The path of the tip as a function of the path parameter, with bounds of how much it bends.
class TipCourse {
 public:
  TipCourse(const Kinematics& kinematics, const Path& path, double from, double to)
      : kinematics_(kinematics), path_(path), from_(from), to_(to), turns_(turns_axis(kinematics, path)) {}

  bool turns() const { return turns_; }

  AxisPlacement at(double s) const { return placement_on(kinematics_, path_, s); }

  bool is_straight() const {
    return !turns_ && path_.kind == PathKind::Polynomial && path_.c[2].head<3>().isZero(0) &&
           path_.c[3].head<3>().isZero(0);
  }
  bool is_helix() const {
    if (turns_ || path_.kind != PathKind::Circle) return false;
    if (path_.is_of_joints && kinematics_.kind != MachineKind::ThreeAxis) return false;
    const Vec3 one = path_.c[1].head<3>();
    const Vec3 other = path_.c[2].head<3>();
    return std::abs(one.norm() - other.norm()) <= 1e-6 && std::abs(one.dot(other)) <= 1e-6 * (1 + one.squaredNorm());
  }

  /// The part of a circle from `s` to `end`.
  geometry::Helix helix(double s, double end) const {
    const Vec3 one = path_.c[1].head<3>();
    const Vec3 other = path_.c[2].head<3>();
    const double angle = path_.omega * s;
    const Vec3 nose = path_.is_of_joints ? Vec3(0, 0, path_.tool_length) : Vec3(Vec3::Zero());
    const double sweep = std::abs(path_.omega) * (end - s);
    return {.center = path_.c[0].head<3>() + s * path_.c[3].head<3>() - nose,
            .out = std::cos(angle) * one + std::sin(angle) * other,
            .side = std::copysign(1.0, path_.omega) * (std::cos(angle) * other - std::sin(angle) * one),
            .rise = (end - s) * path_.c[3].head<3>(),
            .sweep = sweep,
            .cosine = std::cos(sweep),
            .sine = std::sin(sweep)};
  }

  /// As many equal parts as keep all points within reach within `tolerance` of their paths, and by how much each of
  /// them strays. A chord strays by at most an eighth of the second derivative times the square of its length.
  std::pair<double, TipPath> division(const ToolReach& reach, double tolerance) const {
    const double length = to_ - from_;
    const CourseBounds bounds = this->bounds();
    const double bend_of_axis = 2 * bounds.turn_speed * bounds.turn_speed + bounds.turn_acceleration;
    const double square = length * length / 8;
    TipPath piece{.reach = reach_of(reach, bounds.tip_bend * square, bend_of_axis * square)};
    const double bend = bounds.tip_bend + piece.reach * bend_of_axis;
    const double least = std::max(std::sqrt(bend * square / tolerance), length * bounds.turn_speed / kMaxTurn);
    const double parts = std::clamp(std::ceil(least), 1.0, kMaxPieces);
    const double share = square / (parts * parts);
    piece.stray = bounds.tip_bend * share;
    piece.stray_in_height = bounds.rise_bend * share;
    piece.stray_of_axis = bend_of_axis * share;
    return {parts, piece};
  }

 private:
  /// How far from the tip the points are that matter anywhere on the path, which strays from its chord by at most so
  /// much.
  double reach_of(const ToolReach& all, double stray, double stray_of_axis) const {
    const AxisPlacement begin = at(from_);
    const AxisPlacement end = at(to_);
    const double up = std::min(begin.axis.z(), end.axis.z()) - stray_of_axis;
    constexpr double kSteep = 0.1;
    if (up < kSteep || !std::isfinite(all.top)) return all.distance;
    const double lowest = std::min(begin.origin.z(), end.origin.z()) - stray;
    const double highest = std::max(0.0, (all.top + all.radius - lowest) / up);
    constexpr double kLeast = 1;  // mm
    return std::min(all.distance, std::max(kLeast, std::hypot(highest, all.radius)));
  }

  /// How fast the tip bends, mm, and the axis turns, radians; by s.
  struct CourseBounds {
    double tip_bend = 0;
    double rise_bend = 0;  ///< The part of it along Z.
    double turn_speed = 0;
    double turn_acceleration = 0;
  };

  /// From both ends and the middle: second derivatives of a polynomial change linearly, so they are greatest at an end,
  /// and those of a circle are the same everywhere.
  CourseBounds bounds() const {
    CourseBounds all;
    double speed = 0;
    for (const double s : {from_, (from_ + to_) / 2, to_}) {
      const kinematics::Jet at = path_.at(s);
      all.tip_bend = std::max(all.tip_bend, at.second.head<3>().norm());
      all.rise_bend = std::max(all.rise_bend, std::abs(at.second.z()));
      speed = std::max(speed, at.first.head<3>().norm());
      if (!turns_) continue;
      all.turn_speed = std::max(all.turn_speed, rotary(at.first));
      all.turn_acceleration = std::max(all.turn_acceleration, rotary(at.second));
    }
    const double half = (to_ - from_) / 2;
    all.turn_speed += all.turn_acceleration * half;
    // The height of a point of a circle does not bend alike everywhere.
    if (path_.kind != PathKind::Polynomial || path_.is_of_joints) all.rise_bend = all.tip_bend;
    if (!path_.is_of_joints || !turns_) return all;
    speed += all.tip_bend * half;
    // What turns is as long as from the tip to the rotary axes: those of the head, or those of the table.
    const Vec3 tip = at((from_ + to_) / 2).origin;
    const double arm = kinematics::lever(kinematics_, tip, path_.tool_length);
    const double table = kinematics_.kind == MachineKind::Table ? speed * half : 0;
    all.tip_bend = all.tip_bend + 2 * all.turn_speed * speed +
                   (arm + table) * (all.turn_speed * all.turn_speed + all.turn_acceleration);
    all.rise_bend = all.tip_bend;
    return all;
  }
  static double rotary(const kinematics::Coordinates& c) {
    return (std::abs(c[kinematics::kB]) + std::abs(c[kinematics::kC])) * kinematics::kRadians;
  }

  const Kinematics& kinematics_;
  const Path& path_;
  double from_;
  double to_;
  bool turns_;
};

}  // namespace

void append_tip_paths(const Kinematics& kinematics, const Path& path, double from, double to, const ToolReach& reach,
                      double tolerance, std::vector<TipPath>& pieces) {
  if (!(from < to)) return;
  const TipCourse course(kinematics, path, from, to);
  if (course.is_straight()) {
    pieces.push_back({stock::StraightPath{course.at(from), course.at(to).origin}, from, to});
    return;
  }
  const bool is_helix = course.is_helix();
  // Half a turn at most.
  const double half_turns = std::ceil(std::abs(path.omega) * (to - from) / std::numbers::pi);
  const auto [parts, kind] =
      is_helix ? std::pair(half_turns, TipPath{.reach = reach.distance}) : course.division(reach, tolerance);
  AxisPlacement last = course.at(from);
  for (double i = 0; i < parts; ++i) {
    const double begin = from + i * (to - from) / parts;
    const double end = from + (i + 1) * (to - from) / parts;
    TipPath& piece = pieces.emplace_back(kind);
    piece.from = begin;
    piece.to = end;
    if (is_helix) {
      piece.path = stock::HelixPath{course.helix(begin, end), last.axis};
      continue;
    }
    const AxisPlacement next = course.at(end);
    if (course.turns()) {
      piece.path = stock::TurningPath{last, next};
    } else {
      piece.path = stock::StraightPath{last, next.origin};
    }
    last = next;
  }
}

stock::SweepPath shifted_along_axis(const stock::SweepPath& path, double height) {
  if (const auto* const turning = std::get_if<stock::TurningPath>(&path)) {
    stock::TurningPath shifted = *turning;
    shifted.from.origin += height * shifted.from.axis;
    shifted.to.origin += height * shifted.to.axis;
    return shifted;
  }
  return moved(path, height * axis_of(path));
}

stock::SweepPath moved(stock::SweepPath path, const Vec3& shift) {
  if (auto* const turning = std::get_if<stock::TurningPath>(&path)) {
    turning->from.origin += shift;
    turning->to.origin += shift;
  } else if (auto* const straight = std::get_if<stock::StraightPath>(&path)) {
    straight->from.origin += shift;
    straight->to += shift;
  } else {
    std::get<stock::HelixPath>(path).helix.center += shift;
  }
  return path;
}

Vec3 axis_of(const stock::SweepPath& path) {
  if (const auto* const turning = std::get_if<stock::TurningPath>(&path)) return turning->from.axis;
  const auto* const straight = std::get_if<stock::StraightPath>(&path);
  return straight ? straight->from.axis : std::get<stock::HelixPath>(path).axis;
}

AxisPlacement start_of(const stock::SweepPath& path) {
  if (const auto* const turning = std::get_if<stock::TurningPath>(&path)) return turning->from;
  if (const auto* const straight = std::get_if<stock::StraightPath>(&path)) return straight->from;
  const stock::HelixPath& helix = std::get<stock::HelixPath>(path);
  return {helix.helix.center + helix.helix.out, helix.axis};
}

Vec3 end_of(const stock::SweepPath& path) {
  if (const auto* const turning = std::get_if<stock::TurningPath>(&path)) return turning->to.origin;
  if (const auto* const straight = std::get_if<stock::StraightPath>(&path)) return straight->to;
  const geometry::Helix& helix = std::get<stock::HelixPath>(path).helix;
  return helix.center + helix.cosine * helix.out + helix.sine * helix.side + helix.rise;
}

AxisPlacement placement_of(const Kinematics& kinematics, const kinematics::Coordinates& tip) {
  if (kinematics.kind == MachineKind::ThreeAxis) return {tip.head<3>(), Vec3(0, 0, 1)};
  return {tip.head<3>(), geometry::axes_from_angles(tip[kinematics::kB], tip[kinematics::kC]).col(2)};
}

AxisPlacement placement_on(const Kinematics& kinematics, const Path& path, double s) {
  const kinematics::Coordinates value = path.at(s).value;
  return placement_of(kinematics, path.is_of_joints ? kinematics::forward(kinematics, value, path.tool_length) : value);
}

double length_of(const stock::SweepPath& path) {
  if (const auto* const turning = std::get_if<stock::TurningPath>(&path))
    return (turning->to.origin - turning->from.origin).norm();
  if (const auto* const straight = std::get_if<stock::StraightPath>(&path))
    return (straight->to - straight->from.origin).norm();
  return std::get<stock::HelixPath>(path).helix.length();
}

double lowest_along(const stock::SweepPath& path, const Vec3& direction) {
  if (const auto* const turning = std::get_if<stock::TurningPath>(&path))
    return std::min(direction.dot(turning->from.origin), direction.dot(turning->to.origin));
  if (const auto* const straight = std::get_if<stock::StraightPath>(&path))
    return std::min(direction.dot(straight->from.origin), direction.dot(straight->to));
  const geometry::Helix& helix = std::get<stock::HelixPath>(path).helix;
  const double middle = direction.dot(helix.center);
  return middle - std::hypot(direction.dot(helix.out), direction.dot(helix.side)) +
         std::min(0.0, direction.dot(helix.rise));
}

}  // namespace isocnc::removal
