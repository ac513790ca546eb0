#include "interpreter/motion/element.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace isocnc::motion {

using geometry::Pose;
using geometry::Vec3;

static constexpr double kRadians = std::numbers::pi / 180;
/// Shorter ways lead nowhere, mm or degrees.
static constexpr double kNowhere = 1e-9;

static double turning(const Pose& from, const Pose& to) { return std::hypot(to.b - from.b, to.c - from.c); }

static bool turns(const Move& move) { return move.from.b != move.to.b || move.from.c != move.to.c; }

static Coordinates lifted(const Vec3& linear, double b, double c) { return coordinates(Pose{linear, b, c}); }

/// Through both ends even where they are not equally far from the center: what is missing is spread over the way, as
/// the rise of a helix is (I.3.4.3.b).
static Path circle(const Move& move, double& length) {
  const double sweep = move.sweep_deg * kRadians;
  const Vec3 from_center = move.from.tip - move.center;
  const Vec3 out = from_center - move.normal * move.normal.dot(from_center);
  const Vec3 side = move.normal.cross(out);
  const Vec3 center = move.from.tip - out;
  const Vec3 rise = move.to.tip - (center + std::cos(sweep) * out + std::sin(sweep) * side);
  length = std::hypot(out.norm() * sweep, rise.norm());
  Path path;
  path.kind = PathKind::Circle;
  path.omega = sweep / length;
  path.c = {lifted(center, move.from.b, move.from.c), lifted(out, 0, 0), lifted(side, 0, 0),
            lifted(rise / length, 0, 0)};
  path.tool_length = move.tool_length;
  return path;
}

/// A chord over the angle t is off the arc by r (1 - cos(t/2)).
static int chord_count(double radius, double sweep, double tolerance) {
  const double half = std::acos(std::clamp(1 - tolerance / radius, 0.0, 1.0));
  return static_cast<int>(std::clamp(std::ceil(std::abs(sweep) / (2 * half) - 1e-9), 1.0, 1e9));
}

static bool splits(const Move& move) { return move.is_arc && (move.splits_arcs || turns(move)); }

void Splitter::take(const Machine& machine, const Move& move) {
  move_ = move;
  index_ = 0;
  count_ = 1;
  length_ = (move.to.tip - move.from.tip).norm();
  if (length_ <= kNowhere) length_ = turning(move.from, move.to);
  if (move.is_arc) {
    circle_ = circle(move, length_);
    const double sweep = move.sweep_deg * kRadians;
    count_ = splits(move) ? chord_count(circle_.c[1].norm(), sweep, machine.chord_tolerance)
                          : static_cast<int>(std::ceil(std::abs(move.sweep_deg) / 90 - 1e-9));
  }
  if (!(length_ > kNowhere)) count_ = 0;
}

static double feed_speed(const Feed& feed, double length) {
  switch (feed.kind) {
    case FeedKind::Rapid:
      return std::numeric_limits<double>::infinity();
    case FeedKind::Speed:
      return feed.value;
    case FeedKind::Duration:
      return length / feed.value;
  }
  return 0;
}

Element Splitter::next(const Machine& machine) {
  Element element = !move_.is_arc   ? line(machine, move_.from, move_.to, feed_speed(move_.feed, length_))
                    : splits(move_) ? chord(machine)
                                    : arc();
  element.tag = move_.tag;
  ++index_;
  element.ends_move = index_ == count_;
  element.stops = element.ends_move && move_.exact_stop;
  return element;
}

Element Splitter::line(const Machine& machine, const Pose& from, const Pose& to, double feed) const {
  Element element;
  element.length = (to.tip - from.tip).norm();
  element.only_turns = element.length <= kNowhere;
  if (element.only_turns) element.length = turning(from, to);
  element.end = element.length;
  element.feed = feed;
  const bool follows = machine.kinematics.kind != MachineKind::ThreeAxis && (from.b != to.b || from.c != to.c);
  if (follows) element.space = move_.controls_tool_point ? Space::Tip : Space::Joints;
  element.joints_are_straight = element.space != Space::Tip;
  Coordinates begin = coordinates(from);
  Coordinates end = coordinates(to);
  if (element.space == Space::Joints) {
    begin = inverse(machine.kinematics, begin, move_.tool_length);
    end = inverse(machine.kinematics, end, move_.tool_length);
  }
  element.path = Path::line(begin, (end - begin) / element.length);
  element.path.is_of_joints = element.space == Space::Joints;
  element.path.tool_length = move_.tool_length;
  return element;
}

Element Splitter::chord(const Machine& machine) const {
  const auto at = [&](int i) {
    if (i == 0) return move_.from;
    if (i == count_) return move_.to;
    const double part = static_cast<double>(i) / count_;
    Pose result = pose(circle_.at(part * length_).value);
    result.b = move_.from.b + part * (move_.to.b - move_.from.b);
    result.c = move_.from.c + part * (move_.to.c - move_.from.c);
    return result;
  };
  return line(machine, at(index_), at(index_ + 1), feed_speed(move_.feed, length_));
}

Element Splitter::arc() const {
  const Vec3 rise = circle_.c[3].head<3>();
  const double along = rise.dot(move_.normal);
  const double across = (rise - along * move_.normal).norm();
  const double radius = circle_.c[1].norm();
  Element element;
  element.path = circle_;
  element.begin = length_ * index_ / count_;
  element.end = length_ * (index_ + 1) / count_;
  element.length = element.end - element.begin;
  element.curvature = radius * circle_.omega * circle_.omega;
  element.joints_are_straight = false;
  element.feed = feed_speed(move_.feed, length_);
  element.steepest = std::hypot(radius * std::abs(circle_.omega) + across, along);
  return element;
}

}  // namespace isocnc::motion
