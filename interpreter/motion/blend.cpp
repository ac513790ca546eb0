#include "interpreter/motion/blend.h"

#include <algorithm>
#include <cmath>

#include "interpreter/kinematics/limits.h"
#include "interpreter/kinematics/numbers.h"

namespace isocnc::motion {

using geometry::Mat3;

/// Maximum difference of directions that count as equal: rounding of decimals, mm or degrees per mm.
static constexpr double kSameDirection = 1e-9;
/// Maximum angle cut off from an arc, radians. The bound of the deviation holds for small angles only.
static constexpr double kMaxCut = 0.25;
/// Maximum part of an element cut off from each end. The speed is constant in corners, so on a chain of short lines it
/// can change only on what is left between two corners.
static constexpr double kMaxElementPart = 0.25;
/// Minimum length cut off where a blend is shortened because of the feed, mm.
static constexpr double kMinCut = 1e-6;

/// Evaluates an element's path in the space where the corner is rounded.
static kinematics::Jet seen_in(const kinematics::Machine& machine, kinematics::Space space,
                               const kinematics::Element& element, double s) {
  const bool turned = space == kinematics::Space::Joints && element.space == kinematics::Space::Either;
  return turned ? element.path.joints_at(machine.kinematics, s) : element.path.at(s);
}

static bool is_arc(const kinematics::Element& element) { return element.path.kind == kinematics::PathKind::Circle; }

static bool can_be_rounded(const kinematics::Element& before, const kinematics::Element& after) {
  if (before.only_turns != after.only_turns || before.path.tool_length != after.path.tool_length) return false;
  if (before.space == after.space) return true;
  // If one element turns B or C, the other must be a line that keeps them. If both turn them in different spaces, they
  // cannot be rounded.
  return (before.space == kinematics::Space::Either || after.space == kinematics::Space::Either) && !is_arc(before) &&
         !is_arc(after);
}

/// The deviation of a kind of blend from the corner, if the length d is cut off from both elements whose directions are
/// e1 and e2: `by_change` d |e2 - e1| + `by_bend` (sum of both curvatures) d^2 (docs/motion.md).
struct Shape {
  double by_change;
  double by_bend;
  double max_element_part;  ///< Maximum part of an element cut off from each end.
};
static constexpr Shape kParabola = {1.0 / 4, 1.3, kMaxElementPart};
static constexpr Shape kSmooth = {13.0 / 72, 0.06, 0.5};

/// Returns the length d to cut off from both elements, mm or degrees.
static double cut(const kinematics::Machine& machine, const Shape& shape, kinematics::Space space,
                  const kinematics::Element& before, const kinematics::Element& after, const kinematics::Jet& corner,
                  const kinematics::Coordinates& change) {
  const double rotary = std::abs(change[kinematics::kB]) + std::abs(change[kinematics::kC]);
  double linear = change.head<3>().norm();
  if (space == kinematics::Space::Joints)
    linear += rotary * kinematics::kRadians *
              lever(machine.kinematics,
                    kinematics::forward(machine.kinematics, corner.value, before.path.tool_length).head<3>(),
                    before.path.tool_length);
  const double bend = shape.by_bend * (before.curvature + after.curvature);
  const double tolerance = machine.corner_tolerance;
  const double turn = linear * shape.by_change;
  double depth = shape.max_element_part * std::min(before.length, after.length);
  depth = std::min(depth, 2 * tolerance / (turn + std::sqrt(kinematics::square(turn) + 4 * bend * tolerance)));
  if (bend > 0) depth = std::min(depth, kMaxCut / std::max(before.curvature, after.curvature));
  if (rotary > 0) depth = std::min(depth, machine.corner_tolerance_deg / shape.by_change / rotary);
  return depth;
}

/// Returns the Hermite cubic over [0, length] through the values and slopes of both ends.
static kinematics::Path hermite(const kinematics::Jet& from, const kinematics::Jet& to, double length) {
  const double part = 1 / length;
  const kinematics::Coordinates chord = part * (to.value - from.value);
  kinematics::Path path;
  path.c = {from.value, from.first, part * (3 * chord - 2 * from.first - to.first),
            kinematics::square(part) * (from.first + to.first - 2 * chord)};
  return path;
}

/// Returns the parabola to which that cubic reduces between two lines, given both lines at their corner.
static kinematics::Path parabola(const kinematics::Jet& arriving, const kinematics::Jet& leaving, double length) {
  kinematics::Path path;
  path.c = {arriving.value - length / 2 * arriving.first, arriving.first,
            (leaving.first - arriving.first) / (2 * length), kinematics::Coordinates::Zero()};
  return path;
}

/// Maxima of (ds/dt)^2, mm^2/s^2.
struct Caps {
  double by_speed = std::numeric_limits<double>::infinity();
  double by_acceleration = std::numeric_limits<double>::infinity();
};

/// Returns the caps for a path whose first derivatives lie within the hull of `slopes`, and second derivatives within
/// that of `bends`.
static Caps axes_caps(const kinematics::Machine& machine, const kinematics::Coordinates (&slopes)[3],
                      const kinematics::Coordinates (&bends)[2]) {
  Caps caps;
  for (int axis = 0; axis < kinematics::kAxisCount; ++axis) {
    const kinematics::AxisLimits& limits = machine.axes[static_cast<std::size_t>(axis)];
    const double slope = std::max({std::abs(slopes[0][axis]), std::abs(slopes[1][axis]), std::abs(slopes[2][axis])});
    const double bend = std::max(std::abs(bends[0][axis]), std::abs(bends[1][axis]));
    if (slope > 0) caps.by_speed = std::min(caps.by_speed, kinematics::square(limits.speed / slope));
    if (bend > 0) caps.by_acceleration = std::min(caps.by_acceleration, limits.acceleration / bend);
  }
  return caps;
}

/// Number of parts of a blend of the tip, whose joints follow curves: the smallest of their caps is that of the blend.
static constexpr int kBlendParts = 4;

static Caps caps_of(const kinematics::Machine& machine, kinematics::Space space, const Blend& blend) {
  if (space == kinematics::Space::Tip)
    return {.by_acceleration = kinematics::curve_cap(machine, blend.path, blend.length, kBlendParts)};
  const auto& c = blend.path.c;
  const kinematics::Coordinates cubic = 3 * blend.length * c[3];
  kinematics::Coordinates slopes[3] = {c[1], c[1] + blend.length * c[2], c[1] + blend.length * (2 * c[2] + cubic)};
  kinematics::Coordinates bends[2] = {2 * c[2], 2 * c[2] + 2 * cubic};
  if (space == kinematics::Space::Either && machine.kinematics.kind == kinematics::MachineKind::Table) {
    const Mat3 turn = kinematics::turn_to_joints(machine.kinematics, blend.path.c[0][kinematics::kB],
                                                 blend.path.c[0][kinematics::kC]);
    for (kinematics::Coordinates& slope : slopes) slope.head<3>() = (turn * slope.head<3>()).eval();
    for (kinematics::Coordinates& bend : bends) bend.head<3>() = (turn * bend.head<3>()).eval();
  }
  return axes_caps(machine, slopes, bends);
}

/// Returns an upper bound of the tip's distance from the rotary axes in a blend of joints, mm.
static double swing_radius(const kinematics::Machine& machine, const Blend& blend) {
  const auto at = [&](double s) {
    const kinematics::Coordinates tip = blend.path.tip_at(machine.kinematics, s).value;
    return kinematics::lever(machine.kinematics, tip.head<3>(), blend.path.tool_length);
  };
  return std::max(at(0), at(blend.length)) + machine.corner_tolerance;
}

/// Returns the maximum of (ds/dt)^2 by the feeds of both elements. The tip's speed at ds/dt = 1 is bounded by the
/// slopes at both ends and in the middle. In a blend of joints, where one of the elements is a rapid, the swing of B
/// and C adds to it; the feed of the other element then applies.
static double feed_cap(const kinematics::Machine& machine, kinematics::Space space, const kinematics::Element& before,
                       const kinematics::Element& after, const Blend& blend) {
  const double feed = std::min(before.feed, after.feed);
  if (std::isinf(feed)) return feed;
  const double swing = space == kinematics::Space::Joints ? kinematics::kRadians * swing_radius(machine, blend) : 0;
  const auto tip_rate = [&](const kinematics::Coordinates& slope) {
    if (before.only_turns) return slope.tail<2>().norm();
    return slope.head<3>().norm() + swing * (std::abs(slope[kinematics::kB]) + std::abs(slope[kinematics::kC]));
  };
  const kinematics::Coordinates middle = blend.path.c[1] + blend.length * blend.path.c[2];
  const double max_tip_rate = std::max({before.max_tip_rate, after.max_tip_rate, tip_rate(middle)});
  const double turn = std::max(std::abs(middle[kinematics::kB]), std::abs(middle[kinematics::kC]));
  return kinematics::square(std::min(feed / max_tip_rate, machine.feed_turn / turn));
}

/// The place where two elements meet, in the space where the corner is rounded.
struct Meeting {
  kinematics::Space space = kinematics::Space::Either;
  kinematics::Jet arriving;
  kinematics::Jet leaving;
};

static Meeting meeting(const kinematics::Machine& machine, const kinematics::Element& before,
                       const kinematics::Element& after) {
  const kinematics::Space space = before.space == kinematics::Space::Either ? after.space : before.space;
  return {space, seen_in(machine, space, before, before.end), seen_in(machine, space, after, after.begin)};
}

static bool is_small(const kinematics::Coordinates& change) { return change.cwiseAbs().maxCoeff() <= kSameDirection; }

Corner corner(const kinematics::Machine& machine, const kinematics::Element& before, const kinematics::Element& after) {
  if (!can_be_rounded(before, after)) return {};
  const auto [space, arriving, leaving] = meeting(machine, before, after);
  const kinematics::Coordinates change = leaving.first - arriving.first;
  if (is_small(change)) return {.junction = Junction::Smooth};
  Corner result{.junction = Junction::Rounded};
  Blend& blend = result.blend;
  const bool between_lines = !is_arc(before) && !is_arc(after);
  const auto round = [&, space = space, &arriving = arriving, &leaving = leaving](double depth) {
    blend.length = 2 * depth;
    const kinematics::Path path = between_lines
                                      ? parabola(arriving, leaving, blend.length)
                                      : hermite(seen_in(machine, space, before, before.end - depth),
                                                seen_in(machine, space, after, after.begin + depth), blend.length);
    blend.path = path;
    blend.path.is_of_joints = space == kinematics::Space::Joints;
    blend.path.tool_length = before.path.tool_length;
    return caps_of(machine, space, blend);
  };
  const double depth = cut(machine, kParabola, space, before, after, arriving, change);
  Caps caps = round(depth);
  double by_feed = feed_cap(machine, space, before, after, blend);
  // The acceleration in a parabola is inversely proportional to its length. So the parabola is shortened where its
  // acceleration would permit more speed than the feed and the speeds of the axes do.
  const double wanted = std::min(caps.by_speed, by_feed);
  if (between_lines && caps.by_acceleration > wanted) {
    caps = round(std::max(depth * wanted / caps.by_acceleration, std::min(depth, kMinCut)));
    by_feed = feed_cap(machine, space, before, after, blend);
  }
  blend.cap = std::min({caps.by_speed, caps.by_acceleration, by_feed});
  return result;
}

/// Returns three cubics of equal length with continuous second derivatives. The values, slopes and second derivatives
/// at both ends determine them uniquely.
static SmoothBlend spline(const kinematics::Jet& from, const kinematics::Jet& to, double length) {
  const double third = length / 3;
  const kinematics::Coordinates turn = (to.first - from.first) / third;
  const kinematics::Coordinates aside = (to.value - from.value - length * from.first) / kinematics::square(third);
  const kinematics::Coordinates first = aside - turn - 5.0 / 6 * from.second + to.second / 3;
  const kinematics::Coordinates second = turn - (from.second + to.second) / 2 - first;
  SmoothBlend blend{.length = length};
  kinematics::Jet at = from;
  const kinematics::Coordinates bends[] = {first, second, to.second};
  for (std::size_t i = 0; i < 3; ++i) {
    kinematics::Path& path = blend.paths[i];
    path.c = {at.value, at.first, at.second / 2, (bends[i] - at.second) / (6 * third)};
    at = path.at(third);
  }
  return blend;
}

SmoothCorner smooth_corner(const kinematics::Machine& machine, const kinematics::Element& before,
                           const kinematics::Element& after) {
  if (!can_be_rounded(before, after)) return {};
  const auto [space, arriving, leaving] = meeting(machine, before, after);
  const kinematics::Coordinates change = leaving.first - arriving.first;
  if (is_small(change) && is_small(leaving.second - arriving.second)) return {.junction = Junction::Smooth};
  const double depth = cut(machine, kSmooth, space, before, after, arriving, change);
  SmoothCorner result{Junction::Rounded, spline(seen_in(machine, space, before, before.end - depth),
                                                seen_in(machine, space, after, after.begin + depth), 2 * depth)};
  for (kinematics::Path& path : result.blend.paths) {
    path.is_of_joints = space == kinematics::Space::Joints;
    path.tool_length = before.path.tool_length;
  }
  return result;
}

}  // namespace isocnc::motion
