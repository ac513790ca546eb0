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

CurveLimits::CurveLimits(const Machine& machine, const Path& path, double from, double to) {
  const Jet ends[] = {path.joints_at(machine.kinematics, from), path.joints_at(machine.kinematics, to)};
  const Wiggle most = wiggle(machine.kinematics, path, from, to);
  const double bulge = square(to - from) / 8;
  cap_ = kInfinity;
  for (int axis = 0; axis < kAxisCount; ++axis) {
    const AxisLimits& limits = machine.axes[static_cast<std::size_t>(axis)];
    const double first_slack = axis < kB ? bulge * most.third : 0;
    const double second_slack = axis < kB ? bulge * most.fourth : 0;
    for (const Jet& jet : ends) {
      const double first = jet.first[axis];
      const double second = jet.second[axis];
      if (first == 0 && second == 0 && first_slack == 0) continue;
      cap_ = std::min(cap_, square(limits.speed / (std::abs(first) + first_slack)));
      cap_ = std::min(cap_, limits.acceleration / (std::abs(second) + second_slack));
      terms_[static_cast<std::size_t>(count_++)] = {first / limits.acceleration, second / limits.acceleration,
                                                    first_slack / limits.acceleration,
                                                    second_slack / limits.acceleration};
    }
  }
}

/// Visits m and n of every bound m x + n |a| <= 1. Those with n <= 0 hold by themselves below the cap.
template <typename Visit>
void CurveLimits::for_each_bound(Direction direction, Visit&& visit) const {
  for (int i = 0; i < count_; ++i) {
    const Terms& terms = terms_[static_cast<std::size_t>(i)];
    const double first = static_cast<int>(direction) * terms.first;
    const double with = terms.first_slack + first;
    const double against = terms.first_slack - first;
    if (with > 0) visit(terms.second_slack + terms.second, with);
    if (against > 0) visit(terms.second_slack - terms.second, against);
  }
}

/// With a constant a, both ends must be within the bounds, then all between is: they are linear in x and a.
double CurveLimits::reach(double x, double length, Direction direction) const {
  double most = kInfinity;
  for_each_bound(direction,
                 [&](double m, double n) { most = std::min(most, (1 - m * x) / (n + 2 * length * std::max(m, 0.0))); });
  return std::min(cap_, x + 2 * length * std::max(most, 0.0));
}

double CurveLimits::acceleration(double x, double peak, Direction direction) const {
  double most = kInfinity;
  for_each_bound(direction, [&](double m, double n) { most = std::min(most, (1 - m * (m > 0 ? peak : x)) / n); });
  return std::max(most, 0.0);
}

}  // namespace isocnc::motion
