#include "interpreter/running/timing.h"

#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace isocnc::running {

using execution::MoveKind;

motion::Machine unbounded_machine() {
  motion::Machine machine = motion::default_machine();
  for (motion::AxisLimits& axis : machine.axes) {
    axis.least = -std::numeric_limits<double>::infinity();
    axis.most = std::numeric_limits<double>::infinity();
  }
  return machine;
}

static constexpr double kSecondsPerMinute = 60;

static double degrees_turned(const MoveEvent& move) {
  return std::hypot(move.to.b - move.from.b, move.to.c - move.from.c);
}

double feed_of(const MoveEvent& move) {
  if (move.kind == MoveKind::Rapid) return 0;
  if (!move.inverse_time) return move.feed;
  return move.feed * (move.length > 0 ? move.length : degrees_turned(move));
}

std::string to_json(const TimedEvent& timed) {
  std::array<std::pair<std::string_view, double>, 3> more;
  std::size_t count = 0;
  const auto* const move = std::get_if<MoveEvent>(&timed.event.what);
  if (move != nullptr && move->kind != MoveKind::Rapid) more[count++] = {"feed", feed_of(*move)};
  more[count++] = {"start", timed.start};
  more[count++] = {"duration", timed.duration};
  return to_json(timed.event, std::span(more).first(count));
}

static motion::Feed planner_feed(const MoveEvent& move) {
  if (move.kind == MoveKind::Rapid || !(move.feed > 0)) return {};
  if (move.inverse_time) return {motion::FeedKind::Duration, kSecondsPerMinute / move.feed};
  return {motion::FeedKind::Speed, move.feed / kSecondsPerMinute};
}

static motion::Move planner_move(const MoveEvent& move, std::uint64_t tag, double tool_length) {
  motion::Move planned;
  planned.tag = tag;
  planned.from = move.from;
  planned.to = move.to;
  planned.is_arc = move.kind == MoveKind::Arc;
  planned.center = move.center;
  planned.normal = move.normal;
  planned.sweep_deg = move.sweep_deg;
  planned.feed = planner_feed(move);
  planned.splits_arcs = move.five_axis;
  planned.controls_tool_point = move.kind != MoveKind::Rapid;  // A rapid is a positioning of the axes (I.3.4.1).
  planned.tool_length = tool_length;
  return planned;
}

Timing::Timing(const TimedMachine& machine, Listeners listeners)
    : machine_(machine), listeners_(std::move(listeners)), planner_(machine.motion) {}

void Timing::take(const Event& event) {
  if (std::holds_alternative<ExactStopEvent>(event.what)) {
    stops_exactly_ = holds_motion_;
    return;
  }
  push_motion();
  if (std::holds_alternative<MoveEvent>(event.what)) {
    waiting_.push_back({.timed = {.event = event}, .motion = motions_++, .is_motion = true});
    holds_motion_ = true;
    return;
  }
  const double seconds = seconds_of(event);
  if (seconds >= 0) return rest(event, seconds);
  waiting_.push_back({.timed = {.event = event}, .motion = motions_});
}

/// The motion that waited for a G09.
void Timing::push_motion() {
  if (!std::exchange(holds_motion_, false)) return;
  const bool stops = std::exchange(stops_exactly_, false);
  const MoveEvent& move = std::get<MoveEvent>(waiting_.back().timed.event.what);
  motion::Move planned = planner_move(move, waiting_.back().motion, tool_length_);
  planned.exact_stop = stops;
  if (listeners_.move) listeners_.move(planned, waiting_.back().timed.event.line);
  planner_.push(planned);
  // In three-axis interpolation the channel runs empty; in five-axis the motion goes on at once (I.3.8).
  if (stops && !move.five_axis) planner_.rest(machine_.durations.channel);
  take_stretches();
}

void Timing::take_stretches() {
  while (const motion::Stretch* const stretch = planner_.next()) take_stretch(*stretch);
}

void Timing::take_stretch(const motion::Stretch& stretch) {
  const auto goes_before = [&](const Waiting& waiting) {
    return waiting.motion < stretch.tag || (waiting.motion == stretch.tag && !waiting.is_motion);
  };
  while (!waiting_.empty() && goes_before(waiting_.front())) {
    Waiting& first = waiting_.front();
    if (!first.has_begun) first.timed.start = stretch.start;
    tell_first();
  }
  if (listeners_.stretch) listeners_.stretch(stretch);
  if (waiting_.empty()) return;
  Waiting& moving = waiting_.front();
  if (!std::exchange(moving.has_begun, true)) moving.timed.start = stretch.start;
  moving.timed.duration = stretch.start + stretch.duration - moving.timed.start;
  if (stretch.ends_move) tell_first();
}

void Timing::tell_first() {
  if (listeners_.event) listeners_.event(waiting_.front().timed);
  waiting_.pop_front();
}

/// The machine stands still before and after what happens now.
void Timing::rest(const Event& event, double seconds) {
  planner_.rest();
  take_stretches();
  for (; !waiting_.empty(); tell_first())
    if (!waiting_.front().has_begun) waiting_.front().timed.start = planner_.time();
  const double start = planner_.time();
  planner_.rest(seconds);
  if (listeners_.event) listeners_.event({.event = event, .start = start, .duration = seconds});
  if (const auto* const tool = std::get_if<ToolEvent>(&event.what)) {
    const auto length = machine_.tool_lengths.find(tool->tool);
    tool_length_ = length == machine_.tool_lengths.end() ? 0 : length->second;
  }
}

/// How long the machine stands still for it; negative when it does not.
double Timing::seconds_of(const Event& event) const {
  const Durations& durations = machine_.durations;
  if (const auto* const dwell = std::get_if<DwellEvent>(&event.what)) return dwell->seconds;
  if (std::holds_alternative<ToolEvent>(event.what)) return durations.tool_change;
  if (const auto* const function = std::get_if<FunctionEvent>(&event.what)) {
    if (!dialect::is_user_function(function->number)) return durations.spindle;
    const auto named = durations.functions.find(function->number);
    return named == durations.functions.end() ? 0 : named->second;
  }
  const bool waits = std::holds_alternative<JumpEvent>(event.what) || std::holds_alternative<EndEvent>(event.what);
  return waits ? 0 : -1;
}

void Timing::finish() {
  push_motion();
  planner_.rest();
  take_stretches();
  for (; !waiting_.empty(); tell_first())
    if (!waiting_.front().has_begun) waiting_.front().timed.start = planner_.time();
}

}  // namespace isocnc::running
