#include "interpreter/motion/blend.h"

#include <algorithm>
#include <cmath>

#include "interpreter/kinematics/limits.h"
#include "interpreter/kinematics/numbers.h"

namespace isocnc::motion {

/// Maximum difference of directions that count as equal: rounding of decimals, mm or degrees per mm.
static constexpr double kSameDirection = 1e-9;
/// Maximum angle cut off from an arc, radians. The bound of the deviation holds for small angles only.
static constexpr double kMaxCut = 0.25;
/// Maximum part of an element cut off from each end. The speed is constant in corners, so on a chain of short lines it
/// can change only on what is left between two corners.
static constexpr double kMaxElementPart = 0.25;
/// Minimum length cut off where a blend is shortened because of the feed, mm.
static constexpr double kMinCut = 1e-6;
/// By how much more a blend of the tip is cut off than the axes need at the corner. The joints' directions change a
/// little along the blend; without a reserve the corner would be passed a little more slowly than the lines beside it.
static constexpr double kCutReserve = 1.01;

/// Evaluates an element's path in the space where the corner is rounded.
static kinematics::Jet seen_in(const kinematics::Machine& machine, kinematics::Space space,
                               const kinematics::Element& element, double s) {
  const bool turned = space == kinematics::Space::Joints && element.space == kinematics::Space::Either;
  if (turned) return element.path.joints_at(machine.kinematics, s);
  if (element.is_arc()) return element.path.at(s);
  return {.value = element.path.c[0] + s * element.path.c[1], .first = element.path.c[1]};
}

static bool can_be_rounded(const kinematics::Element& before, const kinematics::Element& after) {
  if (before.only_turns != after.only_turns || before.path.tool_length != after.path.tool_length) return false;
  if (before.space == after.space) return true;
  // If one element turns B or C, the other must be a line that keeps them. If both turn them in different spaces, they
  // cannot be rounded.
  return (before.space == kinematics::Space::Either || after.space == kinematics::Space::Either) && !before.is_arc() &&
         !after.is_arc();
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

/// Returns how far B and C swing the tip in a blend of joints at most, mm for a degree.
static double swing_of(const kinematics::Machine& machine, const Blend& blend) {
  const auto at = [&](double s) {
    const kinematics::Coordinates tip = blend.path.tip_at(machine.kinematics, s).value;
    return kinematics::lever(machine.kinematics, tip.head<3>(), blend.path.tool_length);
  };
  return kinematics::kRadians * (std::max(at(0), at(blend.length)) + machine.corner_tolerance);
}

/// Returns the maximum of (ds/dt)^2 by the feeds of both elements, for a blend with this slope in the middle. The tip's
/// speed at ds/dt = 1 is bounded by the slopes at both ends and in the middle. In a blend of joints, where one of the
/// elements is a rapid, the swing of B and C adds to it, mm for a degree; the feed of the other element then applies.
static double feed_cap(const kinematics::Machine& machine, const kinematics::Element& before,
                       const kinematics::Element& after, const kinematics::Coordinates& middle, double swing) {
  const double feed = std::min(before.feed, after.feed);
  if (std::isinf(feed)) return feed;
  const double tip_rate =
      before.only_turns
          ? middle.tail<2>().norm()
          : middle.head<3>().norm() + swing * (std::abs(middle[kinematics::kB]) + std::abs(middle[kinematics::kC]));
  const double max_tip_rate = std::max({before.max_tip_rate, after.max_tip_rate, tip_rate});
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

/// The joints' derivatives by those of the path of a corner, at one place.
class JointsAt {
 public:
  JointsAt(const kinematics::Machine& machine, kinematics::Space space, const kinematics::Coordinates& place,
           double tool_length) {
    const bool is_table = machine.kinematics.kind == kinematics::MachineKind::Table;
    if (space == kinematics::Space::Tip || (space == kinematics::Space::Either && is_table))
      inverse_.emplace(machine.kinematics, place, tool_length);
  }

  kinematics::Derivatives derivatives(const kinematics::Derivatives& of_path) const {
    return inverse_ ? inverse_->derivatives(of_path) : of_path;
  }

 private:
  std::optional<kinematics::InverseAt> inverse_;  ///< Absent where the joints have the derivatives of the path.
};

/// Returns the least length to cut off from two lines for the axes to pass the corner as fast as they pass the lines,
/// or as the feed permits ((ds/dt)^2 `by_feed`); at most `depth`. The joints' second derivatives are those of a change
/// of direction within 2 d, and those of lines of the tip that turn B and C.
static double needed_cut(const kinematics::Machine& machine, const kinematics::Derivatives& arriving,
                         const kinematics::Derivatives& leaving, double by_feed, double depth) {
  double speed = std::sqrt(by_feed);
  for (int axis = 0; axis < kinematics::kAxisCount; ++axis)
    speed = std::min(speed, machine.axes[static_cast<std::size_t>(axis)].speed /
                                std::max(std::abs(arriving.first[axis]), std::abs(leaving.first[axis])));
  const double wanted = kinematics::square(speed);
  double needed = std::min(depth, kMinCut);
  for (int axis = 0; axis < kinematics::kAxisCount; ++axis) {
    const double bend = std::max(std::abs(arriving.second[axis]), std::abs(leaving.second[axis]));
    const double left = machine.axes[static_cast<std::size_t>(axis)].acceleration - bend * wanted;
    if (!(left > 0)) return depth;
    needed = std::max(needed, wanted * std::abs(leaving.first[axis] - arriving.first[axis]) / (2 * left));
  }
  return std::min(needed, depth);
}

/// Joins two lines by a parabola. Its acceleration is inversely proportional to its length: it is as short as the axes
/// and the feed permit without passing more slowly than the lines.
static Corner line_corner(const kinematics::Machine& machine, const Meeting& meeting, const kinematics::Element& before,
                          const kinematics::Element& after) {
  const auto& [space, arriving, leaving] = meeting;
  const double tool_length = before.path.tool_length;
  Corner result{.junction = Junction::Rounded};
  Blend& blend = result.blend;
  const auto round = [&, &arriving = arriving, &leaving = leaving, space = space](double depth) {
    blend.length = 2 * depth;
    blend.path = parabola(arriving, leaving, blend.length);
    blend.path.is_of_joints = space == kinematics::Space::Joints;
    blend.path.tool_length = tool_length;
  };
  const auto by_feed = [&, &arriving = arriving, &leaving = leaving, space = space] {
    return feed_cap(machine, before, after, (arriving.first + leaving.first) / 2,
                    space == kinematics::Space::Joints ? swing_of(machine, blend) : 0);
  };
  double depth = cut(machine, kParabola, space, before, after, arriving, leaving.first - arriving.first);
  if (space == kinematics::Space::Joints) round(depth);
  const JointsAt corner(machine, space, arriving.value, tool_length);
  const kinematics::Derivatives slope_before = corner.derivatives({arriving.first});
  const kinematics::Derivatives slope_after = corner.derivatives({leaving.first});
  const double needed = needed_cut(machine, slope_before, slope_after, by_feed(), depth);
  round(space == kinematics::Space::Tip ? std::min(depth, kCutReserve * needed) : needed);
  depth = blend.length / 2;
  const kinematics::Coordinates bend = 2 * blend.path.c[2];
  if (space != kinematics::Space::Tip) {
    const kinematics::Coordinates joint_bend = (slope_after.first - slope_before.first) / blend.length;
    blend.cap = std::min(
        by_feed(), kinematics::curve_cap(machine, {slope_before.first, joint_bend}, {slope_after.first, joint_bend}));
    return result;
  }
  const JointsAt begin(machine, space, before.path.c[0] + (before.end - depth) * before.path.c[1], tool_length);
  const JointsAt end(machine, space, after.path.c[0] + (after.begin + depth) * after.path.c[1], tool_length);
  result.joints_before = begin.derivatives({arriving.first});
  result.joints_after = end.derivatives({leaving.first});
  blend.cap = std::min(
      by_feed(), kinematics::curve_cap(machine, blend.path, blend.length, begin.derivatives({arriving.first, bend}),
                                       end.derivatives({leaving.first, bend})));
  return result;
}

/// Joins two elements, one of which is an arc, by a cubic.
static Corner arc_corner(const kinematics::Machine& machine, const Meeting& meeting, const kinematics::Element& before,
                         const kinematics::Element& after) {
  const auto& [space, arriving, leaving] = meeting;
  const double depth = cut(machine, kParabola, space, before, after, arriving, leaving.first - arriving.first);
  Corner result{.junction = Junction::Rounded};
  Blend& blend = result.blend;
  blend.length = 2 * depth;
  blend.path = hermite(seen_in(machine, space, before, before.end - depth),
                       seen_in(machine, space, after, after.begin + depth), blend.length);
  blend.path.tool_length = before.path.tool_length;
  const auto& c = blend.path.c;
  const kinematics::Coordinates middle = c[1] + blend.length * c[2];
  const kinematics::Coordinates cubic = 3 * blend.length * c[3];
  const JointsAt joints(machine, space, c[0], blend.path.tool_length);
  const double by_axes =
      kinematics::curve_cap(machine, joints.derivatives({c[1], 2 * c[2]}),
                            joints.derivatives({c[1] + blend.length * (2 * c[2] + cubic), 2 * c[2] + 2 * cubic}));
  // The first derivatives lie within the hull of those at both ends and this one.
  const double by_middle = kinematics::line_limits(machine, joints.derivatives({middle}).first).cap;
  blend.cap = std::min({by_axes, by_middle, feed_cap(machine, before, after, middle, 0)});
  return result;
}

Corner corner(const kinematics::Machine& machine, const kinematics::Element& before, const kinematics::Element& after) {
  if (!can_be_rounded(before, after)) return {};
  const Meeting meeting = motion::meeting(machine, before, after);
  if (is_small(meeting.leaving.first - meeting.arriving.first)) return {.junction = Junction::Smooth};
  const bool between_lines = !before.is_arc() && !after.is_arc();
  return between_lines ? line_corner(machine, meeting, before, after) : arc_corner(machine, meeting, before, after);
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
