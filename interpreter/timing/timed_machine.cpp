#include "interpreter/timing/timed_machine.h"

#include <algorithm>
#include <cmath>

#include "interpreter/kinematics/kinematics.h"
#include "interpreter/kinematics/numbers.h"

namespace isocnc::timing {

using execution::MoveKind;

/// Bounds for numbers in programs: minimum speed of a move (mm/s, deg/s), maximum duration (s).
static constexpr double kSlowest = 1e-6;
static constexpr double kLongest = 1e9;

kinematics::Machine unbounded_machine() {
  kinematics::Machine machine = kinematics::default_machine();
  for (kinematics::AxisLimits& axis : machine.axes) {
    axis.minimum = -std::numeric_limits<double>::infinity();
    axis.maximum = std::numeric_limits<double>::infinity();
  }
  return machine;
}

ToolLength TimedMachine::length_of(const execution::ToolCode& tool) const {
  const auto found = tool_lengths.find(tool);
  const double length = found == tool_lengths.end() ? 0 : found->second;
  return {length, length > 0 || tool == execution::ToolCode()};
}

double TimedMachine::highest_tip(const execution::ToolCode& tool, double b, double c) const {
  const kinematics::Coordinates tip = kinematics::coordinates({geometry::Vec3::Zero(), b, c});
  const kinematics::Coordinates nose = kinematics::inverse(motion.kinematics, tip, tool_length(tool));
  return std::floor((motion.axes[kinematics::kZ].maximum - nose[kinematics::kZ]) * 1000) / 1000;
}

static kinematics::Feed planner_feed(const running::MoveEvent& move, double feed_override) {
  if (move.kind == MoveKind::Rapid || !(move.feed > 0)) return {};
  const double feed = move.feed * feed_override;
  if (move.inverse_time)
    return {kinematics::FeedKind::Duration, std::min(kinematics::kSecondsPerMinute / feed, kLongest)};
  return {kinematics::FeedKind::Speed, std::max(feed / kinematics::kSecondsPerMinute, kSlowest)};
}

kinematics::Move planned_move(const running::MoveEvent& move, const TimedMachine& machine, double tool_length) {
  kinematics::Move planned;
  planned.from = move.from;
  planned.to = move.to;
  planned.is_arc = move.kind == MoveKind::Arc;
  planned.center = move.center;
  planned.normal = move.normal;
  planned.sweep_deg = move.sweep_deg;
  planned.feed = planner_feed(move, machine.feed_override);
  planned.splits_arcs = move.five_axis;
  planned.controls_tool_point = move.kind != MoveKind::Rapid;  // A rapid is a positioning of the axes (I.3.4.1).
  planned.tool_length = tool_length;
  return planned;
}

}  // namespace isocnc::timing
