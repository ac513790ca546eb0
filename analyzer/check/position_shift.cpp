#include "analyzer/check/position_shift.h"

#include <cmath>

#include "interpreter/geometry/increment.h"

namespace isocnc::check {

using execution::Axis;
using execution::kAxisCount;
using geometry::Pose;

/// The maximum of a shift: the part of the exact range that PositionUse::far leaves free.
static constexpr double kFarthestShift = geometry::kFarthestStep / 2;

static double& coordinate(Pose& pose, int axis) { return axis < 3 ? pose.tip[axis] : axis == 3 ? pose.b : pose.c; }
static double coordinate(const Pose& pose, int axis) { return axis < 3 ? pose.tip[axis] : axis == 3 ? pose.b : pose.c; }

static bool has(execution::AxisSet axes, int axis) {
  return (axes & execution::axis_bit(static_cast<Axis>(axis))) != 0;
}

void PositionShift::drop(execution::AxisSet dropped) {
  axes &= static_cast<execution::AxisSet>(~dropped);
  for (int axis = 0; axis < kAxisCount; ++axis)
    if (!has(axes, axis)) coordinate(by, axis) = 0;
}

bool PositionShift::add(const PositionShift& other) {
  PositionShift sum = *this;
  for (int axis = 0; axis < kAxisCount; ++axis) {
    if (!has(other.axes, axis)) continue;
    double& distance = coordinate(sum.by, axis);
    distance = geometry::advanced(distance, coordinate(other.by, axis));
    if (std::abs(distance) > kFarthestShift) return false;
    const execution::AxisSet bit = execution::axis_bit(static_cast<Axis>(axis));
    sum.axes = static_cast<execution::AxisSet>(distance == 0 ? sum.axes & ~bit : sum.axes | bit);
  }
  *this = sum;
  return true;
}

static void apply_to(Pose& pose, const PositionShift& shift) {
  for (int axis = 0; axis < kAxisCount; ++axis)
    if (has(shift.axes, axis))
      coordinate(pose, axis) = geometry::advanced(coordinate(pose, axis), coordinate(shift.by, axis));
}

void PositionShift::apply(Frontier& frontier) const {
  if (empty()) return;
  frontier.change_each([&](Groups& groups) {
    for (Group& group : groups) apply_to(group.state.position, *this);
  });
}

/// The shift from one position to another; nothing if it would not give exactly that position.
static std::optional<PositionShift> shift_between(const Pose& from, const Pose& to) {
  PositionShift shift;
  for (int axis = 0; axis < kAxisCount; ++axis) {
    const double before = coordinate(from, axis);
    const double after = coordinate(to, axis);
    if (before == after) continue;
    if (!geometry::is_on_step(before) || !geometry::is_on_step(after)) return std::nullopt;
    const double distance = geometry::advanced(after, -before);
    if (std::abs(distance) > kFarthestShift || geometry::advanced(before, distance) != after) return std::nullopt;
    coordinate(shift.by, axis) = distance;
    shift.axes |= execution::axis_bit(static_cast<Axis>(axis));
  }
  return shift;
}

/// Any group of the frontier; null if there is none.
static const Group* any_group(const Frontier& frontier) {
  if (!frontier.live.empty()) return &frontier.live[0];
  return frontier.waiting().empty() ? nullptr : &frontier.waiting().begin()->second[0];
}

std::optional<PositionShift> shift_between(const Frontier& from, const Frontier& to) {
  const Group* const before = any_group(from);
  const Group* const after = any_group(to);
  if (!before || !after) return from == to ? std::optional(PositionShift{}) : std::nullopt;
  const auto shift = shift_between(before->state.position, after->state.position);
  if (!shift) return std::nullopt;
  Frontier shifted = from;
  shift->apply(shifted);
  return shifted == to ? shift : std::nullopt;
}

}  // namespace isocnc::check
