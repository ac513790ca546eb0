#include "interpreter/kinematics/limits.h"

#include <algorithm>
#include <cmath>

#include "interpreter/kinematics/numbers.h"

namespace isocnc::kinematics {

/// Maximum second and third derivative that count as straight, 1/mm and 1/mm^2.
static constexpr double kStraight = 1e-15;
/// Maximum part of an axis's acceleration that is given up where the bounds at both ends of a piece become one.
static constexpr double kSameBound = 1e-3;
/// Maximum part of a cap that the slack between the ends of a path may take; else the path is looked at in parts.
static constexpr double kMaxSlack = 0.005;
static constexpr int kSlackParts = 4;

LineLimits line_limits(const Machine& machine, const Coordinates& joint_slope) {
  double speed = kInfinity;
  double acceleration = kInfinity;
  for (int axis = 0; axis < kAxisCount; ++axis) {
    const double slope = std::abs(joint_slope[axis]);
    if (slope == 0) continue;
    const AxisLimits& limits = machine.axes[static_cast<std::size_t>(axis)];
    speed = std::min(speed, limits.speed / slope);
    acceleration = std::min(acceleration, limits.acceleration / slope);
  }
  return {square(speed), acceleration};
}

LineLimits circle_limits(const Machine& machine, const Path& circle) {
  LineLimits result{kInfinity, kInfinity, 0};
  for (int axis = 0; axis < kAxisCount; ++axis) {
    const AxisLimits& limits = machine.axes[static_cast<std::size_t>(axis)];
    const double swing = std::abs(circle.omega) * std::sqrt(square(circle.c[1][axis]) + square(circle.c[2][axis]));
    const double slope = swing + std::abs(circle.c[3][axis]);
    if (slope == 0) continue;
    result.cap = std::min(result.cap, square(limits.speed / slope));
    result.acceleration = std::min(result.acceleration, limits.acceleration / slope);
    result.fall = std::max(result.fall, swing * std::abs(circle.omega) / limits.acceleration);
  }
  if (result.fall > 0) result.cap = std::min(result.cap, 1 / result.fall);
  return result;
}

/// Returns the maximum of a function that deviates from the straight line between its ends by at most `bulge`.
static Coordinates largest(const Coordinates& begin, const Coordinates& end, const Coordinates& bulge) {
  return begin.cwiseAbs().cwiseMax(end.cwiseAbs()) + bulge;
}

DerivativeBounds derivative_bounds(const Kinematics& kinematics, const Path& path, double from, double to) {
  const Jet begin = path.joints_at(kinematics, from);
  const Jet end = path.joints_at(kinematics, to);
  const HigherDerivativeBounds higher = higher_derivative_bounds(kinematics, path, from, to);
  Coordinates third = Coordinates::Zero();
  Coordinates fourth = Coordinates::Zero();
  if (path.kind == PathKind::Polynomial) third = 6 * path.c[3].cwiseAbs();
  third.head<3>() = higher.third;
  fourth.head<3>() = higher.fourth;
  const double bulge = square(to - from) / 8;
  return {largest(begin.first, end.first, bulge * third), largest(begin.second, end.second, bulge * fourth), third};
}

double smoothing_window(const Machine& machine) {
  double window = 0;
  for (const AxisLimits& axis : machine.axes)
    if (axis.jerk)
      window = std::max(window, std::min(axis.acceleration / *axis.jerk, std::sqrt(axis.speed / *axis.jerk)));
  return window;
}

/// Maximum ratio of the x at which the permitted acceleration becomes 0 to the cap of x. A greater ratio would leave
/// less for the acceleration.
static constexpr double kMaxFallRatio = 9;

/// Returns the limits by one axis on a curve: |a| <= acceleration (1 - fall x). `first`, `second`, `third`: bounds of
/// the axis's derivatives by s. With z^2 = fall x, the jerk from the second and the third derivative is at most part
/// jerk (z^3 + 1.5 (z - z^3)), which is at most part jerk.
static LineLimits smoothed_curve(const AxisLimits& axis, const Smoothing& smoothing, double first, double second,
                                 double third, double cap) {
  double zero_x = std::min(axis.acceleration / second, kMaxFallRatio * cap);
  if (!axis.jerk) return {cap, axis.acceleration / first, 1 / zero_x};
  const double jerk = *axis.jerk;
  if (third > 0) zero_x = std::min(zero_x, std::pow(smoothing.curves_part * jerk / third, 2.0 / 3));
  const double speed = std::sqrt(zero_x);
  // The part that makes both limits of the acceleration equal, if the third derivative permits it.
  const double swing = 2 * second * speed * smoothing.window;
  const double part = std::clamp(third * zero_x * speed / jerk,
                                 std::min(swing / (first + swing), smoothing.curves_part), smoothing.curves_part);
  const double along = std::min(axis.acceleration, (1 - part) * jerk * smoothing.window) / first;
  return {cap, std::min(along, part * jerk / (2 * second * speed)), 1 / zero_x};
}

/// Returns the limits by one axis on a line.
static LineLimits smoothed_line(const AxisLimits& axis, const Smoothing& smoothing, double first, double cap) {
  return {cap, std::min(axis.acceleration, axis.jerk ? *axis.jerk * smoothing.window : kInfinity) / first, 0};
}

LineLimits smoothed_limits(const Machine& machine, const Smoothing& smoothing, const DerivativeBounds& bounds,
                           double cap) {
  LineLimits result{cap, kInfinity, 0};
  for (int i = 0; i < kAxisCount; ++i)
    result.cap = std::min(result.cap, square(machine.axes[static_cast<std::size_t>(i)].speed / bounds.first[i]));
  const double cap_by_speed = result.cap;
  for (int i = 0; i < kAxisCount; ++i) {
    const AxisLimits& axis = machine.axes[static_cast<std::size_t>(i)];
    const bool is_curved = bounds.second[i] > kStraight || bounds.third[i] > kStraight;
    if (!is_curved && !(bounds.first[i] > 0)) continue;
    const LineLimits limits = is_curved
                                  ? smoothed_curve(axis, smoothing, bounds.first[i],
                                                   std::max(bounds.second[i], kStraight), bounds.third[i], cap_by_speed)
                                  : smoothed_line(axis, smoothing, bounds.first[i], cap_by_speed);
    result.acceleration = std::min(result.acceleration, limits.acceleration);
    result.fall = std::max(result.fall, limits.fall);
  }
  if (result.fall > 0) result.cap = std::min(result.cap, 1 / result.fall);
  return result;
}

static Slack slack_of(int axis, const HigherDerivativeBounds& higher, double length) {
  if (axis >= kB) return {};
  const double bulge = square(length) / 8;
  return {bulge * higher.third[axis], bulge * higher.fourth[axis]};
}

/// Returns the maximum of x by the speeds and accelerations of the axes on a piece of a curve.
static double cap_between(const Machine& machine, const Derivatives& begin, const Derivatives& end,
                          const HigherDerivativeBounds& higher, double length) {
  double by_speed = 0;         // Inverse of the maximum of ds/dt.
  double by_acceleration = 0;  // Inverse of the maximum of x.
  for (int axis = 0; axis < kAxisCount; ++axis) {
    const AxisLimits& limits = machine.axes[static_cast<std::size_t>(axis)];
    const Slack slack = slack_of(axis, higher, length);
    const double first = std::max(std::abs(begin.first[axis]), std::abs(end.first[axis]));
    const double second = std::max(std::abs(begin.second[axis]), std::abs(end.second[axis]));
    by_speed = std::max(by_speed, 1 / limits.speed * (first + slack.first));
    by_acceleration = std::max(by_acceleration, 1 / limits.acceleration * (second + slack.second));
  }
  return 1 / std::max(square(by_speed), by_acceleration);
}

CurveLimits::CurveLimits(const Machine& machine, const Derivatives& begin, const Derivatives& end,
                         const HigherDerivativeBounds& higher, double length)
    : length_(length), cap_(cap_between(machine, begin, end, higher, length)) {
  for (int axis = 0; axis < kAxisCount; ++axis) {
    const double first[] = {begin.first[axis], end.first[axis]};
    const double second[] = {begin.second[axis], end.second[axis]};
    const Slack slack = slack_of(axis, higher, length);
    if (first[0] == 0 && first[1] == 0 && second[0] == 0 && second[1] == 0 && slack.first == 0) continue;
    const double part = 1 / machine.axes[static_cast<std::size_t>(axis)].acceleration;
    const geometry::Range slope{std::min(first[0], first[1]), std::max(first[0], first[1])};
    const geometry::Range bend{std::min(second[0], second[1]), std::max(second[0], second[1])};
    const bool are_alike = (bend.maximum - bend.minimum) * part * cap_ <= kSameBound &&
                           slope.maximum - slope.minimum <= kSameBound * std::abs(first[0]);
    if (are_alike) {
      add(part, slope, bend, slack);
    } else {
      add(part, {first[0], first[0]}, {second[0], second[0]}, slack);
      add(part, {first[1], first[1]}, {second[1], second[1]}, slack);
    }
  }
}

/// Adds the bounds of an axis with these derivatives, both multiplied by `part`. Bounds with n <= 0 are omitted, since
/// they hold for every x within the cap.
void CurveLimits::add(double part, const geometry::Range& slope, const geometry::Range& bend, const Slack& slack) {
  const double ahead = part * (slack.first + slope.maximum);
  const double back = part * (slack.first - slope.minimum);
  const double bend_up = part * (slack.second + bend.maximum);
  const double bend_down = part * (slack.second - bend.minimum);
  const auto append = [&](Bounds& bounds, double m, double n) {
    bounds.bounds[bounds.count++] = {m, n, 1 / (n + 2 * length_ * std::max(m, 0.0))};
  };
  if (ahead > 0) {
    append(forward_, bend_up, ahead);
    append(backward_, bend_down, ahead);
  }
  if (back > 0) {
    append(forward_, bend_down, back);
    append(backward_, bend_up, back);
  }
}

double curve_cap(const Machine& machine, const Derivatives& begin, const Derivatives& end) {
  return cap_between(machine, begin, end, {}, 0);
}

double curve_cap(const Machine& machine, const Path& path, double length, const Derivatives& begin,
                 const Derivatives& end) {
  const Kinematics& kinematics = machine.kinematics;
  const double whole = cap_between(machine, begin, end, higher_derivative_bounds(kinematics, path, 0, length), length);
  if (whole >= (1 - kMaxSlack) * curve_cap(machine, begin, end)) return whole;
  double cap = kInfinity;
  double from = 0;
  Derivatives at_from = begin;
  for (int i = 1; i <= kSlackParts; ++i) {
    const double to = length * i / kSlackParts;
    const Derivatives at_to = i == kSlackParts ? end : path.joints_at(kinematics, to).derivatives();
    const HigherDerivativeBounds higher = higher_derivative_bounds(kinematics, path, from, to);
    cap = std::min(cap, cap_between(machine, at_from, at_to, higher, to - from));
    from = to;
    at_from = at_to;
  }
  return cap;
}

/// With a constant a, the piece keeps the bounds if both of its ends do: the bounds are linear in x and a.
double reach(std::span<const CurveBound> bounds, double length, double x) {
  double min = kInfinity;
  for (const CurveBound& bound : bounds) min = std::min(min, (1 - bound.m * x) * bound.by_length);
  return x + 2 * length * std::max(min, 0.0);
}

double acceleration(std::span<const CurveBound> bounds, double x, double peak) {
  double min = kInfinity;
  for (const CurveBound& bound : bounds) min = std::min(min, (1 - bound.m * (bound.m > 0 ? peak : x)) / bound.n);
  return std::max(min, 0.0);
}

}  // namespace isocnc::kinematics
