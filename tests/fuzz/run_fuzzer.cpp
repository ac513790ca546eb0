#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "interpreter/restart/restart.h"
#include "interpreter/running/runner.h"
#include "interpreter/simulation/compensation.h"
#include "interpreter/summary/summary.h"
#include "require.h"

namespace isocnc::fuzz {

/// Lines end at CR, LF or CRLF; a run may end after the last.
static std::uint64_t max_lines(std::string_view text) {
  return 1 + static_cast<std::uint64_t>(
                 std::count_if(text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }));
}

static void run_program(std::string_view text, bool stop_at_errors) {
  running::RunOptions options;
  options.vgpl = 1;
  options.stop_at_errors = stop_at_errors;
  std::uint64_t line = 0;
  const auto result = running::run(text, options, [&](const running::Event& event) {
    require(event.line >= line, "a run goes forward");
    line = event.line;
    require(!running::to_json(event).empty(), "events can be written");
  });
  require(result.line <= max_lines(text), "a run ends within the text");
  require(result.blocks <= max_lines(text), "no block runs twice");
  require(stop_at_errors || result.ending != running::Ending::Until, "nothing but `until` ends a run there");
}

/// Head, travel and tools: all that a motion can meet.
static timing::TimedMachine machine() {
  timing::TimedMachine machine{.motion = kinematics::head_router()};
  machine.tool_lengths[execution::tool_code(101001)] = 120;
  machine.home.tip.z() = 500;
  return machine;
}

/// Arcs of many meters take the planner its time, and show nothing that shorter ones do not: the rest of such a program
/// is left out.
static void time_program(std::string_view text) {
  constexpr double kLongestPath = 500;
  const timing::TimedMachine timed_on = machine();
  summary::Summary summary(timed_on);
  std::size_t taken = 0;
  std::size_t reported = 0;
  double last = 0;
  timing::Timing timing(timed_on, {.event = [&](const timing::TimedEvent& timed) {
                          ++reported;
                          require(timed.start >= last - 1e-9 * last, "events come in the order of their times");
                          require(timed.duration >= 0 && std::isfinite(timed.start + timed.duration),
                                  "times are numbers");
                          last = timed.start;
                          summary.add(timed);
                        }});
  double way = 0;
  running::RunOptions options;
  options.setup.home = timed_on.home;
  const auto result = running::run(text, options, [&](const running::Event& event) {
    if (const auto* const move = std::get_if<running::MoveEvent>(&event.what)) way += move->length;
    if (!(way <= kLongestPath)) return;
    if (!std::holds_alternative<running::ExactStopEvent>(event.what)) ++taken;
    timing.take(event);
  });
  timing.finish();
  require(reported == taken, "each event is reported once");
  require(std::isfinite(timing.time()), "a run ends");
  summary.finish(result, timing.time(), timing.joints(), {});
  require(!summary.json("-", dialect::Language::English).empty(), "a run has its summary");
  require(!summary.text(dialect::Language::Italian).empty(), "a run has its summary");
}

static void follow_tool(std::string_view text) {
  timing::TimedMachine machine;
  machine.tool_radii[{1, 1, 1}] = 4;
  std::uint64_t line = 0;
  std::uint64_t warned = 0;
  const simulation::Compensation::Listeners listeners{
      .event =
          [&](const running::Event& event) {
            require(event.line >= line, "a tool goes forward");
            line = event.line;
          },
      .warning = [&](const simulation::RunWarning& warning) { warned = std::max(warned, warning.line); }};
  simulation::Compensation compensation(machine);
  running::RunOptions options;
  options.stop_at_errors = false;
  running::run(text, options, [&](const running::Event& event) { compensation.take(event, listeners); });
  compensation.finish(listeners);
  require(warned <= max_lines(text), "warnings have their line");
}

static void restart_program(std::string_view text) {
  restart::RestartOptions options;
  options.line = text.size() % max_lines(text);
  options.machine = machine();
  options.run.setup.home = options.machine.home;
  const auto made = restart::restart_program(text, options);
  if (const auto* const program = std::get_if<std::string>(&made)) {
    const auto result = running::run(*program, options.run, [](const running::Event&) {});
    require(result.ending == running::Ending::ProgramEnd, "a restart program ends");
    require(text.empty() || program->back() == text.back(), "and as the text does");
    return;
  }
  const auto& refusal = std::get<restart::RestartRefusal>(made);
  require(!restart::message(refusal, dialect::Language::Italian).empty(), "a refusal has its reason");
}

}  // namespace isocnc::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = isocnc::fuzz::as_text(data, size);
  isocnc::fuzz::run_program(text, true);
  isocnc::fuzz::run_program(text, false);
  isocnc::fuzz::time_program(text);
  isocnc::fuzz::follow_tool(text);
  isocnc::fuzz::restart_program(text);
  return 0;
}
