#include "interpreter/kinematics/element.h"

#include <algorithm>
#include <cmath>

#include "interpreter/geometry/helix.h"
#include "interpreter/kinematics/numbers.h"

namespace isocnc::kinematics {

using geometry::Pose;
using geometry::Vec3;

/// Maximum length of a move that counts as no motion, mm or degrees.
static constexpr double kNowhere = 1e-9;
/// Maximum number of chords of an arc. Only circles with a radius of about 20 km would need more.
static constexpr int kMaxChords = 100'000;
static constexpr int kMaxTurns = 1'000'000;

static double turning(const Pose& from, const Pose& to) { return std::hypot(to.b - from.b, to.c - from.c); }

static bool turns(const Move& move) { return move.from.b != move.to.b || move.from.c != move.to.c; }

static Coordinates lifted(const Vec3& linear, double b, double c) { return coordinates(Pose{linear, b, c}); }

ProgrammedPath programmed_circle(const Move& move) {
  const geometry::Helix helix = geometry::helix(move.from.tip, move.to.tip, move.center, move.normal, move.sweep_deg);
  const double length = helix.length();
  Path path;
  path.kind = PathKind::Circle;
  path.omega = length > 0 ? helix.sweep / length : 0;
  path.c = {lifted(helix.center, move.from.b, move.from.c), lifted(helix.out, 0, 0), lifted(helix.side, 0, 0),
            lifted(length > 0 ? Vec3(helix.rise / length) : Vec3(Vec3::Zero()), 0, 0)};
  path.tool_length = move.tool_length;
  return {path, length};
}

bool swings(const Machine& machine, const Move& move) {
  return turns(move) && !move.controls_tool_point && machine.kinematics.kind != MachineKind::ThreeAxis;
}

ProgrammedPath programmed_line(const Machine& machine, const Move& move, const Pose& from, const Pose& to) {
  ProgrammedPath result;
  result.length = (to.tip - from.tip).norm();
  result.only_turns = result.length <= kNowhere;
  if (result.only_turns) result.length = turning(from, to);
  if (result.length <= kNowhere) result.length = 0;
  const bool is_of_joints = swings(machine, move);
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

int part_count(double parts, int max) {
  if (!(parts > 1)) return 1;
  return parts < max ? static_cast<int>(std::ceil(parts)) : max;
}

/// Returns the number of chords of an arc. A chord over the angle t deviates from the arc by r (1 - cos(t/2)).
static int chord_count(double radius, double sweep, double tolerance) {
  const double half = std::acos(std::clamp(1 - tolerance / radius, 0.0, 1.0));
  return part_count(std::abs(sweep) / (2 * half) - 1e-9, kMaxChords);
}

static bool splits(const Move& move) { return move.is_arc && (move.splits_arcs || turns(move)); }

int segment_count(const Machine& machine, const Move& move) {
  if (!splits(move)) return 1;
  const double radius = programmed_circle(move).path.c[1].norm();
  return chord_count(radius, move.sweep_deg * kRadians, machine.chord_tolerance);
}

void Splitter::take(const Machine& machine, const Move& move) {
  move_ = move;
  index_ = 0;
  count_ = 1;
  whole_ = move.is_arc ? programmed_circle(move) : programmed_line(machine, move, move.from, move.to);
  if (splits(move))
    count_ = segment_count(machine, move);
  else if (move.is_arc)
    count_ = part_count(std::abs(move.sweep_deg) / 360 - 1e-9, kMaxTurns);
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

/// Returns the maximum of ds/dt on feed moves by the machine's limits for the tip, B and C, mm/s or degrees/s.
static double max_feed(const Machine& machine, const Element& element) {
  const Coordinates& slope = element.path.c[1];  // On circles B and C rest.
  const double turn = std::max(std::abs(slope[kB]), std::abs(slope[kC]));
  const double max = element.only_turns ? std::numeric_limits<double>::infinity() : machine.feed_speed;
  return turn > 0 ? std::min(max, machine.feed_turn / turn) : max;
}

Element Splitter::next(const Machine& machine) {
  Element element = !move_.is_arc ? line(machine, whole_) : splits(move_) ? chord(machine) : arc();
  element.feed = feed_speed(move_.feed, whole_.length);
  if (move_.feed.kind != FeedKind::Rapid) element.feed = std::min(element.feed, max_feed(machine, element));
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
  element.max_tip_rate = std::sqrt(square(radius * std::abs(whole_.path.omega) + across) + square(along));
  return element;
}

}  // namespace isocnc::kinematics
