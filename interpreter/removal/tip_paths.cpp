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

namespace {

/// The path of the tip as a function of the path parameter, with bounds of how much it bends.
class TipCourse {
 public:
  TipCourse(const Kinematics& kinematics, const Path& path, double from, double to)
      : kinematics_(kinematics), path_(path), from_(from), to_(to), turns_(turns_axis(kinematics, path)) {}

  bool turns() const { return turns_; }

  AxisPlacement at(double s) const {
    const kinematics::Coordinates value = path_.at(s).value;
    const kinematics::Coordinates tip =
        path_.is_of_joints ? kinematics::forward(kinematics_, value, path_.tool_length) : value;
    return placement_of(kinematics_, tip);
  }

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

  /// How many equal parts keep all points up to `reach` above the tip within `tolerance` of their paths. A chord strays
  /// by at most an eighth of the second derivative times the square of its length.
  double parts(double reach, double tolerance) const {
    const double length = to_ - from_;
    const CourseBounds bounds = this->bounds();
    const double bend =
        bounds.tip_bend + reach * (2 * bounds.turn_speed * bounds.turn_speed + bounds.turn_acceleration);
    const double parts = std::max(length * std::sqrt(bend / (8 * tolerance)), length * bounds.turn_speed / kMaxTurn);
    return std::clamp(std::ceil(parts), 1.0, kMaxPieces);
  }

 private:
  /// How fast the tip bends, mm, and the axis turns, radians; by s.
  struct CourseBounds {
    double tip_bend = 0;
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
      speed = std::max(speed, at.first.head<3>().norm());
      if (!turns_) continue;
      all.turn_speed = std::max(all.turn_speed, rotary(at.first));
      all.turn_acceleration = std::max(all.turn_acceleration, rotary(at.second));
    }
    const double half = (to_ - from_) / 2;
    all.turn_speed += all.turn_acceleration * half;
    if (!path_.is_of_joints || !turns_) return all;
    speed += all.tip_bend * half;
    // What turns is as long as from the tip to the rotary axes: those of the head, or those of the table.
    const Vec3 tip = at((from_ + to_) / 2).origin;
    const double arm = kinematics::lever(kinematics_, tip, path_.tool_length);
    const double table = kinematics_.kind == MachineKind::Table ? speed * half : 0;
    all.tip_bend = all.tip_bend + 2 * all.turn_speed * speed +
                   (arm + table) * (all.turn_speed * all.turn_speed + all.turn_acceleration);
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

void append_tip_paths(const Kinematics& kinematics, const Path& path, double from, double to, double reach,
                      double tolerance, std::vector<TipPath>& pieces) {
  if (!(from < to)) return;
  const TipCourse course(kinematics, path, from, to);
  if (course.is_straight()) {
    pieces.push_back({stock::StraightPath{course.at(from), course.at(to).origin}, from, to});
    return;
  }
  const bool is_helix = course.is_helix();
  // Half a turn at most.
  const double parts =
      is_helix ? std::ceil(std::abs(path.omega) * (to - from) / std::numbers::pi) : course.parts(reach, tolerance);
  AxisPlacement last = course.at(from);
  for (double i = 0; i < parts; ++i) {
    const double begin = from + i * (to - from) / parts;
    const double end = from + (i + 1) * (to - from) / parts;
    if (is_helix) {
      pieces.push_back({stock::HelixPath{course.helix(begin, end), last.axis}, begin, end});
      continue;
    }
    const AxisPlacement next = course.at(end);
    if (course.turns()) {
      pieces.push_back({stock::TurningPath{last, next}, begin, end});
    } else {
      pieces.push_back({stock::StraightPath{last, next.origin}, begin, end});
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
