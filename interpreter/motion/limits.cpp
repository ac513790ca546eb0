#include "interpreter/motion/limits.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace isocnc::motion {

static constexpr double kInfinity = std::numeric_limits<double>::infinity();

static double square(double value) { return value * value; }

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

CurveLimits::CurveLimits(const Machine& machine, const Path& path, double from, double to)
    : length_(to - from), cap_(kInfinity) {
  const Jet ends[] = {path.joints_at(machine.kinematics, from), path.joints_at(machine.kinematics, to)};
  const Wiggle most = wiggle(machine.kinematics, path, from, to);
  const double bulge = square(length_) / 8;
  for (int axis = 0; axis < kAxisCount; ++axis) {
    const AxisLimits& limits = machine.axes[static_cast<std::size_t>(axis)];
    const double first_slack = axis < kB ? bulge * most.third[axis] : 0;
    const double second_slack = axis < kB ? bulge * most.fourth[axis] : 0;
    for (const Jet& jet : ends) {
      const double first = jet.first[axis];
      const double second = jet.second[axis];
      if (first == 0 && second == 0 && first_slack == 0) continue;
      cap_ = std::min(cap_, square(limits.speed / (std::abs(first) + first_slack)));
      cap_ = std::min(cap_, limits.acceleration / (std::abs(second) + second_slack));
      const double part = 1 / limits.acceleration;
      add(Direction::Forward, part * (second_slack + second), part * (first_slack + first));
      add(Direction::Forward, part * (second_slack - second), part * (first_slack - first));
      add(Direction::Backward, part * (second_slack + second), part * (first_slack - first));
      add(Direction::Backward, part * (second_slack - second), part * (first_slack + first));
    }
  }
}

/// Below the cap, bounds with n <= 0 hold by themselves.
void CurveLimits::add(Direction direction, double m, double n) {
  if (n <= 0) return;
  Bounds& bounds = direction == Direction::Forward ? forward_ : backward_;
  bounds.bounds[bounds.count++] = {m, 1 / n, 1 / (n + 2 * length_ * std::max(m, 0.0))};
}

/// With a constant a, both ends must be within the bounds, then all between is: they are linear in x and a.
double CurveLimits::reach(double x, Direction direction) const {
  const Bounds& all = bounds(direction);
  double most = kInfinity;
  for (std::size_t i = 0; i < all.count; ++i)
    most = std::min(most, (1 - all.bounds[i].m * x) * all.bounds[i].by_length);
  return std::min(cap_, x + 2 * length_ * std::max(most, 0.0));
}

double CurveLimits::acceleration(double x, double peak, Direction direction) const {
  const Bounds& all = bounds(direction);
  double most = kInfinity;
  for (std::size_t i = 0; i < all.count; ++i) {
    const Bound& bound = all.bounds[i];
    most = std::min(most, (1 - bound.m * (bound.m > 0 ? peak : x)) * bound.by_n);
  }
  return std::max(most, 0.0);
}

}  // namespace isocnc::motion
