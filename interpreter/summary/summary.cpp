#include "interpreter/summary/summary.h"

#include <algorithm>
#include <cmath>

namespace isocnc::summary {

using execution::MoveKind;

Summary::Summary(const timing::TimedMachine& machine)
    : machine_(machine),
      checks_travel_(std::any_of(machine.motion.axes.begin(), machine.motion.axes.end(), [](const auto& axis) {
        return std::isfinite(axis.minimum) || std::isfinite(axis.maximum);
      })) {}

/// The share of the mounted tool; before the first M06, the share without a tool.
ToolShare& Summary::share() {
  if (share_ == kNoShare) mount(std::nullopt);
  return tools_[share_];
}

void Summary::mount(std::optional<execution::ToolCode> tool) {
  const auto known =
      std::find_if(tools_.begin(), tools_.end(), [&](const ToolShare& share) { return share.tool == tool; });
  share_ = static_cast<std::size_t>(known - tools_.begin());
  if (known == tools_.end()) tools_.push_back({.tool = tool});
}

/// The kind of activity of an event; none for events that take no time.
static std::optional<Work> work_of(const running::Event& event) {
  if (const auto* const move = std::get_if<running::MoveEvent>(&event.what)) return static_cast<Work>(move->kind);
  if (std::holds_alternative<running::DwellEvent>(event.what)) return Work::Dwell;
  if (std::holds_alternative<running::ToolEvent>(event.what)) return Work::ToolChange;
  if (const auto* const function = std::get_if<running::FunctionEvent>(&event.what))
    return dialect::is_user_function(function->number) ? Work::Function : Work::Spindle;
  return std::nullopt;
}

void Summary::add(const timing::TimedEvent& timed) {
  if (!timed.move) return add(timed, nullptr);
  kinematics::MadeMove made(machine_.motion, *timed.move);
  add(timed, &made);
}

void Summary::add(const timing::TimedEvent& timed, kinematics::MadeMove* made) {
  has_inches_ |= timed.event.is_in_inches;
  const running::Event& event = timed.event;
  if (const auto* const tool = std::get_if<running::ToolEvent>(&event.what)) mount(tool->tool);
  if (const std::optional<Work> work = work_of(event)) spend(*work, timed.duration);
  spend(Work::Channel, timed.wait);
  if (const auto* const frame = std::get_if<running::FrameEvent>(&event.what)) frames_.take(*frame, event.line);
  if (const auto* const spindle = std::get_if<running::SpindleSpeedEvent>(&event.what))
    ask_for(simulation::Limit::SpindleSpeed, spindle->speed, event.line);
  if (made != nullptr) add_move(std::get<running::MoveEvent>(event.what), *made, event.line);
}

void Summary::spend(Work work, double seconds) {
  if (!(seconds > 0)) return;
  times_[static_cast<std::size_t>(work)] += seconds;
  share().times[static_cast<std::size_t>(work)] += seconds;
}

void Summary::add_move(const running::MoveEvent& move, kinematics::MadeMove& made, std::size_t line) {
  const kinematics::Move& real = made.move();
  const auto& [length, linear] = made.tip_travel();
  Travelled& travelled = moves_[static_cast<std::size_t>(move.kind)];
  ++travelled.count;
  travelled.mm += length;
  (move.kind == MoveKind::Rapid ? share().rapid_mm : share().feed_mm) += length;
  reached_ = move.to;
  const auto between = [](double a, double b) { return geometry::Range{std::min(a, b), std::max(a, b)}; };
  const std::array<geometry::Range, execution::kAxisCount> reached = {
      linear[0], linear[1], linear[2], between(real.from.b, real.to.b), between(real.from.c, real.to.c)};
  if (!extents_) extents_ = reached;
  for (std::size_t axis = 0; axis < reached.size(); ++axis) (*extents_)[axis].include(reached[axis]);
  frames_.take(machine_.motion, real, linear);
  look_at_travel(made, line);
  look_at_speeds(made, line);
}

void Summary::look_at_travel(kinematics::MadeMove& made, std::size_t line) {
  if (!checks_travel_) return;
  for (const kinematics::Overtravel& found : made.overtravels()) {
    const std::size_t side = found.position > found.limit ? 1 : 0;
    std::optional<TravelBreach>& breach = breaches_[2 * static_cast<std::size_t>(found.axis) + side];
    if (!breach) breach = TravelBreach{.line = line, .farthest = found.position, .limit = found.limit};
    if (std::abs(found.position - found.limit) > std::abs(breach->farthest - breach->limit))
      breach->farthest = found.position;
  }
}

void Summary::look_at_speeds(kinematics::MadeMove& made, std::size_t line) {
  const simulation::ProgrammedSpeeds speeds = simulation::programmed_speeds(made.move(), made.tip_travel().length);
  ask_for(simulation::Limit::Feed, speeds.feed, line);
  ask_for(simulation::Limit::RotarySpeed, speeds.rotary, line);
}

void Summary::ask_for(simulation::Limit limit, double value, std::size_t line) {
  if (!simulation::exceeds(limit, value, machine_)) return;
  std::optional<Excess>& excess = excesses_[static_cast<std::size_t>(limit)];
  if (!excess) excess = Excess{.line = line};
  excess->maximum = std::max(excess->maximum, value);
}

void Summary::finish(const running::RunResult& result, double seconds, const kinematics::Coordinates& joints,
                     const std::vector<simulation::RunWarning>& warnings) {
  result_ = result;
  seconds_ = seconds;
  joints_ = joints;
  warnings_ = warnings;
}

geometry::Pose Summary::final_pose() const {
  if (reached_) return *reached_;
  const execution::State& state = result_.state;
  return {state.to_machine(state.position.tip), state.position.b, state.position.c};
}

}  // namespace isocnc::summary
