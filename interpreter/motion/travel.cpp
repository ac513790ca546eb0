#include "interpreter/motion/travel.h"

#include <algorithm>

namespace isocnc::motion {

/// Between so many places a joint turns around at most once: stretches are short against a turn of an axis.
static constexpr int kParts = 32;
static constexpr int kHalvings = 50;

static void include(geometry::Range& range, double value) {
  range = {std::min(range.least, value), std::max(range.most, value)};
}

/// Where the joint turns around between `low` and `high`, at whose ends it goes different ways.
static double turning_point(const Path& path, const Kinematics& kinematics, int axis, double low, double high) {
  const bool rises = path.joints_at(kinematics, low).first[axis] > 0;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (low + high) / 2;
    ((path.joints_at(kinematics, middle).first[axis] > 0) == rises ? low : high) = middle;
  }
  return path.joints_at(kinematics, low).value[axis];
}

/// Where the stretch begins and ends on its path.
static std::array<double, 2> ends_of(const Stretch& stretch) {
  const Phase& first = stretch.phases.front();
  const Phase& last = stretch.phases[static_cast<std::size_t>(std::max(stretch.phase_count, 1) - 1)];
  const double t = last.duration;
  return {first.from, last.from + (last.speed + last.acceleration * t / 2) * t};
}

std::array<geometry::Range, kAxisCount> joint_ranges(const Kinematics& kinematics, const Stretch& stretch) {
  const auto [begin, end] = ends_of(stretch);
  const Path& path = stretch.path;
  Jet low = path.joints_at(kinematics, begin);
  std::array<geometry::Range, kAxisCount> ranges;
  for (int axis = 0; axis < kAxisCount; ++axis)
    ranges[static_cast<std::size_t>(axis)] = {low.value[axis], low.value[axis]};
  double at = begin;
  for (int part = 1; part <= kParts; ++part) {
    const double next = begin + (end - begin) * part / kParts;
    const Jet high = path.joints_at(kinematics, next);
    for (int axis = 0; axis < kAxisCount; ++axis) {
      geometry::Range& range = ranges[static_cast<std::size_t>(axis)];
      include(range, high.value[axis]);
      if (low.first[axis] * high.first[axis] < 0) include(range, turning_point(path, kinematics, axis, at, next));
    }
    low = high;
    at = next;
  }
  return ranges;
}

}  // namespace isocnc::motion
