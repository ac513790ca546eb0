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
/// No machine's arcs take so many parts: circles of 20 km do.
static constexpr int kMostChords = 100'000;
static constexpr int kMostQuarters = 1'000'000;

static double turning(const Pose& from, const Pose& to) { return std::hypot(to.b - from.b, to.c - from.c); }

static bool turns(const Move& move) { return move.from.b != move.to.b || move.from.c != move.to.c; }

static Coordinates lifted(const Vec3& linear, double b, double c) { return coordinates(Pose{linear, b, c}); }

/// Through both ends even where they are not equally far from the center: what is missing is spread over the way, as
/// the rise of a helix is (I.3.4.3.b).
ProgrammedPath programmed_circle(const Move& move) {
  const double sweep = move.sweep_deg * kRadians;
  const Vec3 from_center = move.from.tip - move.center;
  const Vec3 out = from_center - move.normal * move.normal.dot(from_center);
  const Vec3 side = move.normal.cross(out);
  const Vec3 center = move.from.tip - out;
  const Vec3 rise = move.to.tip - (center + std::cos(sweep) * out + std::sin(sweep) * side);
  const double length = std::hypot(out.norm() * sweep, rise.norm());
  Path path;
  path.kind = PathKind::Circle;
  path.omega = sweep / length;
  path.c = {lifted(center, move.from.b, move.from.c), lifted(out, 0, 0), lifted(side, 0, 0),
            lifted(rise / length, 0, 0)};
  path.tool_length = move.tool_length;
  return {path, length};
}

ProgrammedPath programmed_line(const Machine& machine, const Move& move, const Pose& from, const Pose& to) {
  ProgrammedPath result;
  result.length = (to.tip - from.tip).norm();
  result.only_turns = result.length <= kNowhere;
  if (result.only_turns) result.length = turning(from, to);
  if (result.length <= kNowhere) result.length = 0;
  const bool turns = from.b != to.b || from.c != to.c;
  const bool is_of_joints = turns && !move.controls_tool_point && machine.kinematics.kind != MachineKind::ThreeAxis;
  Coordinates begin = coordinates(from);
  Coordinates end = coordinates(to);
  if (is_of_joints) {
    begin = inverse(machine.kinematics, begin, move.tool_length);
    end = inverse(machine.kinematics, end, move.tool_length);
  }
  result.path = Path::line(begin, result.length > 0 ? Coordinates((end - begin) / result.length) : Coordinates::Zero());
  result.path.is_of_joints = is_of_joints;
  result.path.tool_length = move.tool_length;
  return result;
}

int part_count(double parts, int most) {
  if (!(parts > 1)) return 1;
  return parts < most ? static_cast<int>(std::ceil(parts)) : most;
}

/// A chord over the angle t is off the arc by r (1 - cos(t/2)).
static int chord_count(double radius, double sweep, double tolerance) {
  const double half = std::acos(std::clamp(1 - tolerance / radius, 0.0, 1.0));
  return part_count(std::abs(sweep) / (2 * half) - 1e-9, kMostChords);
}

static bool splits(const Move& move) { return move.is_arc && (move.splits_arcs || turns(move)); }

void Splitter::take(const Machine& machine, const Move& move) {
  move_ = move;
  index_ = 0;
  count_ = 1;
  whole_ = move.is_arc ? programmed_circle(move) : programmed_line(machine, move, move.from, move.to);
  if (splits(move))
    count_ = chord_count(whole_.path.c[1].norm(), move.sweep_deg * kRadians, machine.chord_tolerance);
  else if (move.is_arc)
    count_ = part_count(std::abs(move.sweep_deg) / 90 - 1e-9, kMostQuarters);
  if (!(whole_.length > 0)) count_ = 0;
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
  Element element = !move_.is_arc ? line(machine, whole_) : splits(move_) ? chord(machine) : arc();
  element.feed = feed_speed(move_.feed, whole_.length);
  element.tag = move_.tag;
  ++index_;
  element.ends_move = index_ == count_;
  element.stops = element.ends_move && move_.exact_stop;
  return element;
}

Element Splitter::line(const Machine& machine, const ProgrammedPath& line) {
  Element element;
  element.path = line.path;
  element.end = element.length = line.length;
  element.only_turns = line.only_turns;
  const bool turns = line.path.c[1][kB] != 0 || line.path.c[1][kC] != 0;
  const bool follows = turns && machine.kinematics.kind != MachineKind::ThreeAxis;
  if (follows) element.space = line.path.is_of_joints ? Space::Joints : Space::Tip;
  element.joints_are_straight = element.space != Space::Tip;
  return element;
}

Element Splitter::chord(const Machine& machine) const {
  const auto at = [&](int i) {
    if (i == 0) return move_.from;
    if (i == count_) return move_.to;
    const double part = static_cast<double>(i) / count_;
    Pose result = pose(whole_.path.at(part * whole_.length).value);
    result.b = move_.from.b + part * (move_.to.b - move_.from.b);
    result.c = move_.from.c + part * (move_.to.c - move_.from.c);
    return result;
  };
  return line(machine, programmed_line(machine, move_, at(index_), at(index_ + 1)));
}

Element Splitter::arc() const {
  const Vec3 rise = whole_.path.c[3].head<3>();
  const double along = rise.dot(move_.normal);
  const double across = (rise - along * move_.normal).norm();
  const double radius = whole_.path.c[1].norm();
  Element element;
  element.path = whole_.path;
  element.begin = whole_.length * index_ / count_;
  element.end = whole_.length * (index_ + 1) / count_;
  element.length = element.end - element.begin;
  element.curvature = radius * whole_.path.omega * whole_.path.omega;
  element.joints_are_straight = false;
  element.steepest = std::hypot(radius * std::abs(whole_.path.omega) + across, along);
  return element;
}

}  // namespace isocnc::motion
