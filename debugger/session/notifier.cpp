#include "debugger/session/notifier.h"

#include <algorithm>
#include <utility>

#include "debugger/session/event_text.h"
#include "interpreter/kinematics/numbers.h"

namespace isocnc::session {

using dialect::Text;
using namespace std::chrono_literals;

/// 60 positions a second.
static constexpr auto kBetweenPositions = 16667us;
/// Progress is reported of what takes longer.
static constexpr auto kPatience = 500ms;
static constexpr auto kBetweenProgress = 200ms;
/// More lines than anybody reads in a second.
static constexpr std::size_t kMaxOutputs = 200;
static constexpr auto kOutputSecond = 1000ms;

static constexpr Text kFileChanged{"the file of the program has changed: restart to debug what it says now",
                                   "il file del programma è cambiato: riavviare per eseguire il nuovo testo"};
static constexpr Text kOmitted{"{} more messages are left out", "altri {} messaggi omessi"};

void Notifier::report_stop(std::string_view reason, Json details) {
  details["reason"] = reason;
  details["threadId"] = 1;
  details["allThreadsStopped"] = true;
  emit_("stopped", details);
}

void Notifier::report_resumption() { emit_("continued", {{"threadId", 1}, {"allThreadsContinued", true}}); }

void Notifier::report_exit(int exit_code) {
  emit_("exited", {{"exitCode", exit_code}});
  emit_("terminated", Json::object());
}

void Notifier::report_invalidated() {
  if (state_.client.supports_invalidated) emit_("invalidated", {{"areas", {"all"}}});
}

// --- Position

void Notifier::report_standing_position() { report_position(false); }

void Notifier::report_running_position() {
  if (Clock::now() - last_position_ >= kBetweenPositions) report_position(true);
}

static Json pose_json(const geometry::Pose& pose) {
  return {{"x", pose.tip.x()}, {"y", pose.tip.y()}, {"z", pose.tip.z()}, {"b", pose.b}, {"c", pose.c}};
}

/// Null where no tool is mounted.
Json Notifier::tool_json() const {
  const execution::ToolCode& tool = state_.debuggee->present().run().state.tool;
  const timing::TimedMachine& machine = state_.debuggee->machine();
  if (tool == execution::ToolCode{}) return nullptr;
  const auto radius = machine.tool_radii.find(tool);
  return {{"name", running::tool_name(tool)},
          {"length", machine.tool_length(tool)},
          {"radius", radius == machine.tool_radii.end() ? 0.0 : radius->second}};
}

void Notifier::report_position(bool is_running) {
  last_position_ = Clock::now();
  const simulation::Simulation& present = state_.debuggee->present();
  const motion::Sample sample = present.sample();
  const execution::State& state = present.run().state;
  emit_("isocnc/position", {{"line", state_.client.to_client_line(present.line())},
                            {"time", present.time()},
                            {"running", is_running},
                            {"tip", pose_json(sample.tip)},
                            {"joints", pose_json(kinematics::pose(sample.joints))},
                            {"programmed", pose_json(expressions::programmed_pose(state_.moment()))},
                            {"speed", sample.speed * kinematics::kSecondsPerMinute},
                            {"spindle", {{"function", state.spindle_function}, {"speed", state.spindle_speed}}},
                            {"tool", tool_json()}});
}

// --- Output

void Notifier::report_output(std::string_view category, const std::string& text, std::optional<std::size_t> line) {
  Json body = {{"category", category}, {"output", text + "\n"}};
  if (line && state_.is_launched()) {
    body["source"] = state_.source();
    body["line"] = state_.client.to_client_line(*line);
  }
  emit_("output", body);
}

/// Counts the line, which is omitted where the second holds too many.
bool Notifier::may_report_event() {
  const auto now = Clock::now();
  if (now - output_second_ > kOutputSecond) {
    report_omissions();
    output_second_ = now;
    outputs_ = 0;
  }
  if (++outputs_ <= kMaxOutputs) return true;
  ++omitted_;
  return false;
}

void Notifier::report_events(std::span<const running::Event> events) {
  for (const running::Event& event : events) {
    if (std::holds_alternative<running::MoveEvent>(event.what)) continue;
    const std::string text = event_text(event, state_);
    if (!text.empty() && may_report_event()) report_output("stdout", text, event.line);
  }
}

void Notifier::report_omissions() {
  if (omitted_ > 0) report_output("console", state_.in_language(kOmitted, std::exchange(omitted_, 0)));
}

void Notifier::report_messages(const breakpoints::Breakpoints::BreakpointOutcome& outcome, std::size_t line) {
  for (const std::string& message : outcome.messages) report_output("console", message, line);
}

// --- Program

void Notifier::report_moved_breakpoint(const Json& breakpoint) {
  emit_("breakpoint", {{"reason", "changed"}, {"breakpoint", breakpoint}});
}

void Notifier::report_file_change(debuggee::FileWatch::FileChange change) {
  report_output("important", std::string(state_.in_language(kFileChanged)));
  const bool is_removed = change == debuggee::FileWatch::FileChange::Removed;
  emit_("loadedSource", {{"reason", is_removed ? "removed" : "changed"}, {"source", state_.source()}});
}

// --- Progress

void Notifier::start_progress() { progress_start_ = last_progress_ = Clock::now(); }

void Notifier::report_progress(const std::string& title, double part) {
  const auto now = Clock::now();
  if (!state_.client.supports_progress || now - progress_start_ < kPatience || now - last_progress_ < kBetweenProgress)
    return;
  last_progress_ = now;
  const int percentage = std::clamp(static_cast<int>(100 * part), 0, 99);
  if (progress_) {
    emit_("progressUpdate", {{"progressId", std::to_string(*progress_)}, {"percentage", percentage}});
    return;
  }
  progress_ = ++progress_ids_;
  emit_("progressStart", {{"progressId", std::to_string(*progress_)},
                          {"title", title},
                          {"cancellable", true},
                          {"percentage", percentage}});
}

void Notifier::end_progress() {
  if (!progress_) return;
  emit_("progressEnd", {{"progressId", std::to_string(*progress_)}});
  progress_.reset();
}

}  // namespace isocnc::session
