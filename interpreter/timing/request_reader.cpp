#include "interpreter/timing/request_reader.h"

#include <algorithm>
#include <utility>

namespace isocnc::timing {

/// Maximum duration of a dwell, s: programs may hold any number.
static constexpr double kLongestDwell = 1e9;

RequestReader::RequestReader(const TimedMachine& machine, const Standing& standing)
    : machine_(&machine),
      position_(standing.tip, standing.programmed, standing.tool, standing.frame_axes, standing.unknown),
      spindle_(standing.spindle),
      spindle_speed_(standing.spindle_speed) {}

void RequestReader::take(const running::Event& event, Receiver& receiver) {
  if (std::holds_alternative<running::ExactStopEvent>(event.what)) {
    stops_exactly_ = holds_motion_;
    return;
  }
  finish(receiver);
  Request& request = add(event, receiver);
  if (std::holds_alternative<running::MoveEvent>(event.what)) {
    holds_motion_ = true;
    return;
  }
  if (const auto* const frame = std::get_if<running::FrameEvent>(&event.what)) position_.take(*frame);
  const double seconds = seconds_of(event);
  turn_spindle(event);
  if (seconds >= 0) complete_rest(request, seconds);
  receiver.complete_last();
}

void RequestReader::finish(Receiver& receiver) {
  if (std::exchange(holds_motion_, false)) complete_motion(receiver);
}

Request& RequestReader::add(const running::Event& event, Receiver& receiver) {
  Request& request = receiver.add();
  request.timed.event = event;
  request.number = count_++;
  return request;
}

std::shared_ptr<const UnknownOffset> RequestReader::unknown_offset() const {
  const UnknownOffset* const offset = position_.unknown_offset();
  return offset ? std::make_shared<const UnknownOffset>(*offset) : nullptr;
}

void RequestReader::complete_motion(Receiver& receiver) {
  Request& request = receiver.last();
  TimedEvent& timed = request.timed;
  const running::MoveEvent& move = std::get<running::MoveEvent>(timed.event.what);
  kinematics::Move& planned = timed.move.emplace(planned_move(move, *machine_, position_.tool_length()));
  planned.tag = request.number;
  timed.begins_at_known_place = is_place_known();
  position_.follow(move, planned);
  timed.ends_at_known_place = is_place_known();
  timed.unknown_offset = unknown_offset();
  planned.exact_stop = std::exchange(stops_exactly_, false);
  // In three-axis interpolation the channel is emptied; in five-axis interpolation the motion continues at once
  // (I.3.8).
  if (planned.exact_stop && !move.five_axis) timed.wait = machine_->durations.channel;
  receiver.complete_last();
}

void RequestReader::complete_rest(Request& request, double seconds) {
  request.rest = seconds;
  request.timed.begins_at_known_place = is_place_known();
  if (const auto* const tool = std::get_if<running::ToolEvent>(&request.timed.event.what))
    position_.mount(machine_->motion.kinematics, machine_->length_of(tool->tool));
  request.timed.ends_at_known_place = is_place_known();
  request.timed.unknown_offset = unknown_offset();
  request.tip = position_.tip();
}

/// Seconds for which the machine stands still for the event; negative if it does not stop.
double RequestReader::seconds_of(const running::Event& event) const {
  const Durations& durations = machine_->durations;
  if (const auto* const dwell = std::get_if<running::DwellEvent>(&event.what))
    return std::min(dwell->seconds, kLongestDwell);
  if (std::holds_alternative<running::ToolEvent>(event.what)) return durations.tool_change;
  if (const auto* const function = std::get_if<running::FunctionEvent>(&event.what)) {
    if (!dialect::is_user_function(function->number))
      return spindle_after(function->number, spindle_speed_) == spindle_ ? 0 : durations.spindle;
    const auto named = durations.functions.find(function->number);
    return named == durations.functions.end() ? 0 : named->second;
  }
  const bool waits = running::stops_reading(event) || std::holds_alternative<running::EndEvent>(event.what);
  return waits ? 0 : -1;
}

void RequestReader::turn_spindle(const running::Event& event) {
  if (const auto* const given = std::get_if<running::SpindleSpeedEvent>(&event.what)) spindle_speed_ = given->speed;
  spindle_ = spindle_after(event, spindle_, spindle_speed_);
}

}  // namespace isocnc::timing
