#include "interpreter/comparison/machine_action.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "interpreter/kinematics/element.h"
#include "interpreter/kinematics/independent_rapid.h"
#include "interpreter/timing/spindle_turn.h"

namespace isocnc::comparison {

/// A motion shorter than this, in mm and degrees, goes nowhere.
static constexpr double kNoMotion = 1e-9;

namespace {

/// Turns the events of a run into actions.
class ActionRecorder {
 public:
  ActionRecorder(std::string_view text, const timing::TimedMachine& machine) : machine_(machine) {
    // Most lines are one action. A list that grows is copied, and a system may be slow to find the memory for copies.
    static constexpr std::ptrdiff_t kMostAtOnce = 2'000'000;
    run_.actions.reserve(static_cast<std::size_t>(std::min(std::count(text.begin(), text.end(), '\n'), kMostAtOnce)) +
                         2);
    run_.machine = machine.motion;
    run_.frames.emplace_back();
    run_.spindles.emplace_back();
  }

  /// `made` is the motion of the event; null if it has none.
  void take(const timing::TimedEvent& timed, kinematics::MadeMove* made) {
    line_ = timed.event.line;
    start_ = timed.start;
    made_ = made;
    std::visit([&](const auto& what) { add(what, timed); }, timed.event.what);
    const double seconds = timed.duration + timed.wait;
    (tool_ == MachineAction::kNone ? run_.seconds_without_tool : run_.tools[tool_].seconds) += seconds;
    run_.seconds = std::max(run_.seconds, timed.start + seconds);
    const timing::SpindleMotion turned = timing::spindle_after(timed.event, spindle_, spindle_speed_);
    if (turned == spindle_) return;
    spindle_ = turned;
    waiting_speed_ = turned.speed;
    // A tool change stops the spindle by itself.
    const bool is_by_tool_change = std::holds_alternative<running::ToolEvent>(timed.event.what);
    run_.spindles.push_back({turned, run_.actions.size() - (is_by_tool_change ? 1 : 0)});
    if (is_by_tool_change) return;
    MachineAction& action = append(ActionKind::Spindle);
    action.number = static_cast<std::uint32_t>(turned.function);
    action.value = turned.speed;
  }

  RecordedRun finish(const running::RunResult& result) {
    line_ = result.line;
    start_ = run_.seconds;
    MachineAction& end = append(ActionKind::End);
    const bool is_error = result.ending == running::Ending::Error;
    end.number = is_error ? 1 + static_cast<std::uint32_t>(result.error.id) : 0;
    return std::move(run_);
  }

 private:
  MachineAction& append(ActionKind kind) {
    MachineAction& action = run_.actions.emplace_back();
    action.kind = kind;
    action.line = static_cast<std::uint32_t>(line_);
    action.start = start_;
    action.tool = tool_;
    action.frame = static_cast<std::uint32_t>(run_.frames.size() - 1);
    action.spindle = static_cast<std::uint32_t>(run_.spindles.size() - 1);
    return action;
  }

  void add(const running::MoveEvent& event, const timing::TimedEvent& timed) {
    const kinematics::Move& move = *timed.move;
    const double turn = std::hypot(move.to.b - move.from.b, move.to.c - move.from.c);
    const bool goes = move.is_arc ? move.sweep_deg != 0 : turn + (move.to.tip - move.from.tip).norm() > kNoMotion;
    if (goes) {
      note_waiting_speed();
      add_motion(event, move, turn);
      if (event.kind == execution::MoveKind::Rapid) add_travel(run_.rapid_mm);
      if (event.kind != execution::MoveKind::Rapid) add_travel(run_.feed_mm);
    }
    if (move.exact_stop) append(ActionKind::ExactStop);
  }
  void add_motion(const running::MoveEvent& event, const kinematics::Move& move, double turn) {
    MachineAction& action = append(ActionKind::Motion);
    action.is_rapid = event.kind == execution::MoveKind::Rapid;
    action.is_inverse_time = event.inverse_time && !action.is_rapid;
    action.is_by_joints = kinematics::swings(machine_.motion, move) || kinematics::leaves_line(machine_.motion, move);
    action.value = action.is_rapid ? 0 : event.feed;
    action.feed = action.is_rapid ? 0 : running::feed_of(event);
    action.from = move.from;
    action.to = move.to;
    if (turn == 0 && (event.compensation.side == 0 || event.compensation.plane_is_sound))
      add_side(event, move.is_arc, action);
    if (!move.is_arc) return;
    action.arc = static_cast<std::uint32_t>(run_.arcs.size());
    run_.arcs.push_back({move.center, move.normal, move.sweep_deg});
  }
  void add_side(const running::MoveEvent& event, bool is_arc, MachineAction& action) const {
    const geometry::Vec3 way = action.to.tip - action.from.tip;
    const double beside_normal = (way - event.normal.dot(way) * event.normal).norm();
    action.has_side = is_arc || beside_normal > kNoMotion;
    if (!action.has_side || event.compensation.side == 0) return;
    action.side = event.compensation.side > 0 ? 41 : 42;
    action.reduces = event.compensation.reduces;
    if (tool_ == MachineAction::kNone) return;
    const auto radius = machine_.tool_radii.find(run_.tools[tool_].code);
    action.is_compensated = radius != machine_.tool_radii.end() && radius->second > 0;
  }
  /// An S that waits for the next M03 or M04 while the machine moves: the custom software may read it before (I.4.2).
  void note_waiting_speed() {
    if (spindle_.function == 5 || spindle_speed_ == waiting_speed_) return;
    waiting_speed_ = spindle_speed_;
    MachineAction& action = append(ActionKind::Spindle);
    action.line = static_cast<std::uint32_t>(speed_line_);
    action.value = spindle_speed_;
  }
  void add_travel(double& length) {
    const kinematics::TipTravel& travel = made_->tip_travel();
    length += travel.length;
    if (!run_.has_motion) run_.extents = travel.extents;
    run_.has_motion = true;
    for (std::size_t axis = 0; axis < 3; ++axis) run_.extents[axis].include(travel.extents[axis]);
  }

  void add(const running::DwellEvent& dwell, const timing::TimedEvent&) {
    if (dwell.seconds > 0) append(ActionKind::Dwell).value = dwell.seconds;
  }
  void add(const running::SpindleSpeedEvent& given, const timing::TimedEvent&) {
    spindle_speed_ = given.speed;
    speed_line_ = line_;
  }
  void add(const running::FunctionEvent& function, const timing::TimedEvent&) {
    if (!dialect::is_user_function(function.number)) return;  // The spindle's, which counts when it turns otherwise.
    append(ActionKind::Function).number = static_cast<std::uint32_t>(run_.functions.size());
    run_.functions.push_back(function);
  }
  void add(const running::ToolEvent& event, const timing::TimedEvent&) {
    const auto known = std::find_if(run_.tools.begin(), run_.tools.end(),
                                    [&](const ActionTool& tool) { return tool.code == event.tool; });
    tool_ = static_cast<std::uint32_t>(known - run_.tools.begin());
    if (known == run_.tools.end()) run_.tools.push_back({event.tool, machine_.tool_length(event.tool)});
    append(ActionKind::Tool);
  }
  void add(const running::FrameEvent& frame, const timing::TimedEvent&) {
    ActionFrame next{line_, frame.in_force, frame.workpiece_origin, run_.frames.back().zero_line};
    if (frame.workpiece_origin != run_.frames.back().zero) next.zero_line = line_;
    run_.frames.push_back(next);
  }
  void add(const running::JumpEvent& jump, const timing::TimedEvent&) {
    run_.decisions.push_back({line_, jump.taken, run_.actions.size()});
  }
  void add(const running::SignalEvent& signal, const timing::TimedEvent&) {
    append(ActionKind::Signal).number = signal.code->number;
  }
  void add(const running::ExactStopEvent&, const timing::TimedEvent&) {}
  void add(const running::EndEvent&, const timing::TimedEvent&) {}

  const timing::TimedMachine& machine_;
  RecordedRun run_;
  std::size_t line_ = 0;
  double start_ = 0;  ///< Of the event, seconds.
  kinematics::MadeMove* made_ = nullptr;
  std::uint32_t tool_ = MachineAction::kNone;
  timing::SpindleMotion spindle_;
  double spindle_speed_ = 0;    ///< The last S.
  std::size_t speed_line_ = 0;  ///< Its line.
  double waiting_speed_ = 0;    ///< The last S that counts: of the spindle as it turns, or one that waits.
};

}  // namespace

std::string_view error_of(const RecordedRun& run) {
  const std::uint32_t number = run.actions.back().number;
  return number == 0 ? std::string_view() : dialect::definition(static_cast<dialect::DiagnosticId>(number - 1)).code;
}

RecordedRun record(std::string_view text, running::RunOptions options, const timing::TimedMachine& machine,
                   const RecordingListeners& listeners) {
  ActionRecorder recorder(text, machine);
  timing::Timing timing(machine, {.event =
                                      [&](const timing::TimedEvent& timed) {
                                        std::optional<kinematics::MadeMove> made;
                                        if (timed.move) made.emplace(machine.motion, *timed.move);
                                        recorder.take(timed, made ? &*made : nullptr);
                                        if (listeners.made) listeners.made(timed, made ? &*made : nullptr);
                                      },
                                  .stretch = listeners.stretch});
  simulation::Compensation compensation(machine);
  const simulation::Compensation::Listeners compensated{
      .event = [&](const running::Event& event) { timing.take(event); },
      .warning =
          [&](const simulation::RunWarning& warning) {
            if (listeners.warning) listeners.warning(warning);
          }};
  options.before_block = listeners.block;
  const running::RunResult result = run(text, options, [&](const running::Event& event) {
    if (listeners.programmed) listeners.programmed(event);
    compensation.take(event, compensated);
  });
  compensation.finish(compensated);
  timing.finish();
  if (listeners.ended) listeners.ended(result);
  return recorder.finish(result);
}

}  // namespace isocnc::comparison
