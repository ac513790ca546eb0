#include "interpreter/motion/blend.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "interpreter/motion/limits.h"

namespace isocnc::motion {

using geometry::Mat3;

static constexpr double kRadians = std::numbers::pi / 180;
/// Directions that differ by less are one: what is left of decimals, mm or degrees per mm.
static constexpr double kSameDirection = 1e-9;
/// Of an arc no more than this is cut, radians: the bound of the deviation is for small angles.
static constexpr double kMostCut = 0.25;
/// From each end of an element no more is cut than this part of it: what is left between two corners, where the speed
/// is constant, is where a chain of short lines can gather speed and lose it.
static constexpr double kMostOfElement = 0.25;
/// Corners are not rounded by less for the feed's sake, mm.
static constexpr double kLeastCut = 1e-6;

static double square(double value) { return value * value; }

/// An element's path as it is seen in the space where the corner is rounded.
static Jet seen_in(const Machine& machine, Space space, const Element& element, double s) {
  const bool turned = space == Space::Joints && element.space == Space::Either;
  return turned ? element.path.joints_at(machine.kinematics, s) : element.path.at(s);
}

static bool is_arc(const Element& element) { return element.path.kind == PathKind::Circle; }

static bool can_be_rounded(const Element& before, const Element& after) {
  if (before.only_turns != after.only_turns || before.path.tool_length != after.path.tool_length) return false;
  if (before.space == after.space) return true;
  // One turns B or C. The other keeps them, and must be a line; or both turn them, in different spaces.
  return (before.space == Space::Either || after.space == Space::Either) && !is_arc(before) && !is_arc(after);
}

/// How far to cut into both sides. A parabola cutting d is off the corner by d |e2 - e1| / 4; an arc's own bend adds at
/// most 1.3 d^2 times the curvature of both (docs/motion.md).
static double cut(const Machine& machine, Space space, const Element& before, const Element& after, const Jet& corner,
                  const Coordinates& change) {
  const double rotary = std::abs(change[kB]) + std::abs(change[kC]);
  double linear = change.head<3>().norm();
  if (space == Space::Joints)
    linear += rotary * kRadians *
              lever(machine.kinematics, forward(machine.kinematics, corner.value, before.path.tool_length).head<3>(),
                    before.path.tool_length);
  const double bend = 1.3 * (before.curvature + after.curvature);
  const double tolerance = machine.corner_tolerance;
  double most = kMostOfElement * std::min(before.length, after.length);
  most = std::min(most, 2 * tolerance / (linear / 4 + std::sqrt(square(linear / 4) + 4 * bend * tolerance)));
  if (bend > 0) most = std::min(most, kMostCut / std::max(before.curvature, after.curvature));
  if (rotary > 0) most = std::min(most, 4 * machine.corner_tolerance_deg / rotary);
  return most;
}

/// The cubic of Hermite over [0, length], with unit parameter speed at both ends; between lines its cube vanishes.
static Path hermite(const Jet& from, const Jet& to, double length) {
  const Coordinates chord = (to.value - from.value) / length;
  Path path;
  path.c = {from.value, from.first, (3 * chord - 2 * from.first - to.first) / length,
            (from.first + to.first - 2 * chord) / square(length)};
  return path;
}

/// The parabola into which it turns between two lines, given at their corner.
static Path parabola(const Jet& arriving, const Jet& leaving, double length) {
  Path path;
  path.c = {arriving.value - length / 2 * arriving.first, arriving.first,
            (leaving.first - arriving.first) / (2 * length), Coordinates::Zero()};
  return path;
}

/// Bounds of the square of ds/dt.
struct Caps {
  double by_speed = std::numeric_limits<double>::infinity();
  double by_acceleration = std::numeric_limits<double>::infinity();
};

/// Bounds of what is within the hull of its ends.
static Caps axes_caps(const Machine& machine, const Coordinates (&slopes)[3], const Coordinates (&bends)[2]) {
  Caps caps;
  for (int axis = 0; axis < kAxisCount; ++axis) {
    const AxisLimits& limits = machine.axes[static_cast<std::size_t>(axis)];
    const double slope = std::max({std::abs(slopes[0][axis]), std::abs(slopes[1][axis]), std::abs(slopes[2][axis])});
    const double bend = std::max(std::abs(bends[0][axis]), std::abs(bends[1][axis]));
    if (slope > 0) caps.by_speed = std::min(caps.by_speed, square(limits.speed / slope));
    if (bend > 0) caps.by_acceleration = std::min(caps.by_acceleration, limits.acceleration / bend);
  }
  return caps;
}

/// Joints that follow the tip in a curve: bounded piece by piece.
static double following_cap(const Machine& machine, const Blend& blend) {
  constexpr int kPieces = 4;
  double cap = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kPieces; ++i)
    cap = std::min(
        cap, CurveLimits(machine, blend.path, blend.length * i / kPieces, blend.length * (i + 1) / kPieces).cap());
  return cap;
}

static Caps caps_of(const Machine& machine, Space space, const Blend& blend) {
  if (space == Space::Tip) return {.by_acceleration = following_cap(machine, blend)};
  Coordinates slopes[3] = {blend.path.c[1], blend.path.c[1] + blend.length * blend.path.c[2],
                           blend.path.at(blend.length).first};
  Coordinates bends[2] = {blend.path.at(0).second, blend.path.at(blend.length).second};
  if (space == Space::Either && machine.kinematics.kind == MachineKind::Table) {
    const Mat3 turn = turn_to_joints(machine.kinematics, blend.path.c[0][kB], blend.path.c[0][kC]);
    for (Coordinates& slope : slopes) slope.head<3>() = (turn * slope.head<3>()).eval();
    for (Coordinates& bend : bends) bend.head<3>() = (turn * bend.head<3>()).eval();
  }
  return axes_caps(machine, slopes, bends);
}

/// The tip's speed for ds/dt = 1 is within the hull of the slopes at the ends and the one between.
static double feed_cap(const Element& before, const Element& after, const Blend& blend) {
  const double feed = std::min(before.feed, after.feed);
  const auto steepness = [&](const Coordinates& slope) {
    return before.only_turns ? slope.tail<2>().norm() : slope.head<3>().norm();
  };
  const Coordinates middle = blend.path.c[1] + blend.length * blend.path.c[2];
  const double steepest = std::max({before.steepest, after.steepest, steepness(middle)});
  return square(feed / steepest);
}

Corner corner(const Machine& machine, const Element& before, const Element& after) {
  if (!can_be_rounded(before, after)) return {};
  const Space space = before.space == Space::Either ? after.space : before.space;
  const Jet arriving = seen_in(machine, space, before, before.end);
  const Jet leaving = seen_in(machine, space, after, after.begin);
  const Coordinates change = leaving.first - arriving.first;
  if (change.cwiseAbs().maxCoeff() <= kSameDirection) return {.junction = Junction::Smooth};
  Corner result{.junction = Junction::Rounded};
  Blend& blend = result.blend;
  const bool between_lines = !is_arc(before) && !is_arc(after);
  const auto round = [&](double depth) {
    blend.length = 2 * depth;
    const Path path = between_lines ? parabola(arriving, leaving, blend.length)
                                    : hermite(seen_in(machine, space, before, before.end - depth),
                                              seen_in(machine, space, after, after.begin + depth), blend.length);
    blend.path = path;
    blend.path.is_of_joints = space == Space::Joints;
    blend.path.tool_length = before.path.tool_length;
    return caps_of(machine, space, blend);
  };
  const double depth = cut(machine, space, before, after, arriving, change);
  Caps caps = round(depth);
  // The acceleration in a parabola is inverse to its length: no longer than the speed on both sides asks for.
  const double wanted = std::min(caps.by_speed, feed_cap(before, after, blend));
  if (between_lines && caps.by_acceleration > wanted)
    caps = round(std::max(depth * wanted / caps.by_acceleration, std::min(depth, kLeastCut)));
  blend.cap = std::min({caps.by_speed, caps.by_acceleration, feed_cap(before, after, blend)});
  return result;
}

}  // namespace isocnc::motion
