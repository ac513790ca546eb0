#include "interpreter/simulation/timing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "interpreter/kinematics/numbers.h"
#include "interpreter/kinematics/travel.h"
#include "interpreter/simulation/spindle_turn.h"

namespace isocnc::simulation {

using execution::MoveKind;

kinematics::Machine unbounded_machine() {
  kinematics::Machine machine = kinematics::default_machine();
  for (kinematics::AxisLimits& axis : machine.axes) {
    axis.minimum = -std::numeric_limits<double>::infinity();
    axis.maximum = std::numeric_limits<double>::infinity();
  }
  return machine;
}

/// Maximum number of waiting events; no control looks ahead so far.
static constexpr std::size_t kMaxWaiting = 32768;
/// Bounds for numbers in programs: minimum speed of a move (mm/s, deg/s), maximum duration (s).
static constexpr double kSlowest = 1e-6;
static constexpr double kLongest = 1e9;

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

double tip_length(const TimedEvent& timed, const TimedMachine& machine) {
  return timed.move ? kinematics::tip_travel(machine.motion, *timed.move).length : 0;
}

std::string to_json(const TimedEvent& timed, const TimedMachine& machine) {
  std::array<std::pair<std::string_view, double>, 4> more;
  std::size_t count = 0;
  const auto* const move = std::get_if<running::MoveEvent>(&timed.event.what);
  if (timed.move) more[count++] = {"lengthMm", tip_length(timed, machine)};
  if (move != nullptr && move->kind != MoveKind::Rapid) more[count++] = {"feed", running::feed_of(*move)};
  more[count++] = {"start", timed.start};
  more[count++] = {"duration", timed.duration};
  return to_json(timed.event, std::span(more).first(count));
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

Timing::Timing(const TimedMachine& machine, Listeners listeners)
    : machine_(&machine), listeners_(std::move(listeners)), planner_(machine.motion), position_(machine.home) {}

Timing::Timing(const TimedMachine& machine, const Standing& standing) : Timing(machine, Listeners{}) {
  planner_.rest(standing.time);
  position_ = {standing.tip, standing.programmed, standing.tool, standing.frame_axes, standing.unknown};
  spindle_ = standing.spindle;
  spindle_speed_ = standing.spindle_speed;
}

void Timing::take(const running::Event& event) {
  if (std::holds_alternative<running::ExactStopEvent>(event.what)) {
    stops_exactly_ = holds_motion_;
    return;
  }
  push_motion();
  if (std::holds_alternative<running::MoveEvent>(event.what)) {
    enqueue(event).is_motion = true;
    ++motions_;
    holds_motion_ = true;
    return;
  }
  if (const auto* const frame = std::get_if<running::FrameEvent>(&event.what)) position_.take(*frame);
  const double seconds = seconds_of(event);
  turn_spindle(event);
  if (seconds >= 0) return rest(event, seconds);
  enqueue(event);
}

std::shared_ptr<const UnknownOffset> Timing::unknown_offset() const {
  const UnknownOffset* const offset = position_.unknown_offset();
  return offset ? std::make_shared<const UnknownOffset>(*offset) : nullptr;
}

Timing::WaitingEvent& Timing::enqueue(const running::Event& event) {
  if (waiting_.size() >= kMaxWaiting) come_to_rest();
  WaitingEvent& waiting = waiting_.emplace_back();
  waiting.timed.event = event;
  waiting.motion = motions_;
  return waiting;
}

/// Plans the motion that was held back for a possible G09.
void Timing::push_motion() {
  if (!std::exchange(holds_motion_, false)) return;
  WaitingEvent& waiting = waiting_.back();
  const running::MoveEvent& move = std::get<running::MoveEvent>(waiting.timed.event.what);
  kinematics::Move planned = planned_move(move, *machine_, position_.tool_length());
  planned.tag = waiting.motion;
  waiting.timed.begins_at_known_place = is_place_known();
  position_.follow(move, planned);
  waiting.timed.ends_at_known_place = is_place_known();
  waiting.timed.unknown_offset = unknown_offset();
  planned.exact_stop = std::exchange(stops_exactly_, false);
  // In three-axis interpolation the channel is emptied; in five-axis interpolation the motion continues at once
  // (I.3.8).
  if (planned.exact_stop && !move.five_axis) waiting.timed.wait = machine_->durations.channel;
  waiting.timed.move = planned;
  const double channel = waiting.timed.wait;
  planner_.push(planned);
  if (channel > 0) planner_.rest(channel);
  take_stretches();
}

void Timing::take_stretches() {
  while (const motion::Stretch* const stretch = planner_.next()) take_stretch(*stretch);
}

void Timing::take_stretch(const motion::Stretch& stretch) {
  const auto goes_before = [&](const WaitingEvent& waiting) {
    return waiting.motion < stretch.tag || (waiting.motion == stretch.tag && !waiting.is_motion);
  };
  while (!waiting_.empty() && goes_before(waiting_.front())) {
    WaitingEvent& first = waiting_.front();
    if (!first.has_begun) first.timed.start = stretch.start;
    report_first();
  }
  if (waiting_.empty()) return;
  WaitingEvent& moving = waiting_.front();
  if (!std::exchange(moving.has_begun, true)) moving.timed.start = stretch.start;
  if (listeners_.stretch) listeners_.stretch(stretch, moving.timed);
  moving.timed.duration = stretch.start + stretch.duration - moving.timed.start;
  if (stretch.ends_move) report_first();
}

void Timing::report_first() {
  if (listeners_.event) listeners_.event(waiting_.front().timed);
  waiting_.pop_front();
}

/// Reports all waiting events: those without a following motion start now.
void Timing::come_to_rest() {
  planner_.rest();
  take_stretches();
  for (; !waiting_.empty(); report_first())
    if (!waiting_.front().has_begun) waiting_.front().timed.start = planner_.time();
}

/// Reports an event for which the machine stands still.
void Timing::rest(const running::Event& event, double seconds) {
  come_to_rest();
  const double start = planner_.time();
  planner_.rest(seconds);
  const bool was_place_known = is_place_known();
  if (const auto* const tool = std::get_if<running::ToolEvent>(&event.what))
    position_.mount(machine_->motion.kinematics, machine_->length_of(tool->tool));
  if (listeners_.event)
    listeners_.event({.event = event,
                      .start = start,
                      .duration = seconds,
                      .begins_at_known_place = was_place_known,
                      .ends_at_known_place = is_place_known(),
                      .unknown_offset = unknown_offset()});
}

/// Seconds for which the machine stands still for the event; negative if it does not stop.
double Timing::seconds_of(const running::Event& event) const {
  const Durations& durations = machine_->durations;
  if (const auto* const dwell = std::get_if<running::DwellEvent>(&event.what))
    return std::min(dwell->seconds, kLongest);
  if (std::holds_alternative<running::ToolEvent>(event.what)) return durations.tool_change;
  if (const auto* const function = std::get_if<running::FunctionEvent>(&event.what)) {
    if (!dialect::is_user_function(function->number))
      return spindle_after(function->number) == spindle_ ? 0 : durations.spindle;
    const auto named = durations.functions.find(function->number);
    return named == durations.functions.end() ? 0 : named->second;
  }
  const bool waits = running::stops_reading(event) || std::holds_alternative<running::EndEvent>(event.what);
  return waits ? 0 : -1;
}

Timing::SpindleMotion Timing::spindle_after(int function) const {
  return simulation::spindle_after(function, spindle_speed_);
}

void Timing::turn_spindle(const running::Event& event) {
  if (const auto* const given = std::get_if<running::SpindleSpeedEvent>(&event.what)) spindle_speed_ = given->speed;
  spindle_ = simulation::spindle_after(event, spindle_, spindle_speed_);
}

void Timing::finish() {
  push_motion();
  come_to_rest();
}

}  // namespace isocnc::simulation
