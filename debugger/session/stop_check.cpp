#include "debugger/session/stop_check.h"

#include <iterator>
#include <utility>
#include <vector>

#include "analyzer/explain.h"
#include "debugger/debuggee/block_effect.h"
#include "interpreter/running/error_message.h"

namespace isocnc::session {

std::optional<Stop> StopCheck::before_block() {
  if (state_.debuggee->present().is_in_block() || std::exchange(is_judged_, false)) return std::nullopt;
  auto due = judge_block();
  if (due) is_judged_ = true;
  return due;
}

std::optional<Stop> StopCheck::on_arrival() {
  coming_.reset();
  if (state_.debuggee->present().is_in_block() || std::exchange(is_judged_, true)) return std::nullopt;
  return judge_block();
}

std::optional<Stop> StopCheck::judge_block() {
  if (state_.launch_options.no_debug || state_.debuggee->present().has_ended()) return std::nullopt;
  if (ends_step_out()) return Stop{.reason = "step"};
  if (auto stop = judge_breakpoints()) return stop;
  return judge_exceptions();
}

std::optional<double> StopCheck::next_moment() {
  const breakpoints::BlockWatch watch = state_.block_watch();
  if (state_.launch_options.no_debug || !watch.is_on()) return std::nullopt;
  const simulation::Simulation& present = state_.debuggee->present();
  const std::uint64_t block = present.blocks() - (present.is_in_block() ? 1 : 0);
  if (!coming_ || coming_->block != block || coming_->revision != watch.revision()) {
    simulation::Simulation ahead = present;
    std::vector<breakpoints::InnerMoment> moments = watch.pass_block(ahead);
    coming_ = {.block = block,
               .revision = watch.revision(),
               .moments = {std::make_move_iterator(moments.begin()), std::make_move_iterator(moments.end())}};
  }
  return coming_->moments.empty() ? std::nullopt : std::optional(coming_->moments.front().time);
}

/// Several may be one moment.
std::optional<Stop> StopCheck::at_moment() {
  const simulation::Simulation& present = state_.debuggee->present();
  breakpoints::MomentVerdict all;
  auto& moments = coming_->moments;
  for (; !moments.empty() && moments.front().time <= present.time(); moments.pop_front()) {
    breakpoints::MomentVerdict each = state_.block_watch().judge(moments.front(), state_.moment(), coming_->block,
                                                                 breakpoints::RunDirection::Forward, state_.language());
    if (all.exception && each.exception) all.exception->message += "; " + each.exception->message;
    if (!all.exception) all.exception = std::move(each.exception);
    all.outcome.stopped.insert(all.outcome.stopped.end(), each.outcome.stopped.begin(), each.outcome.stopped.end());
    report_messages(each.outcome, present.line());
  }
  if (!all.stops()) return std::nullopt;
  return stop_at(std::move(all));
}

Stop StopCheck::at_moment(const breakpoints::InnerMoment& moment, std::uint64_t block) {
  return stop_at(state_.block_watch().judge(moment, state_.moment(), block, breakpoints::RunDirection::Backward,
                                            state_.language()));
}

Stop StopCheck::stop_at(breakpoints::MomentVerdict verdict) {
  if (verdict.exception) return stop_at(std::move(*verdict.exception));
  Stop stop{.reason = "data breakpoint", .details = {{"hitBreakpointIds", verdict.outcome.stopped}}};
  if (!verdict.outcome.stopped.empty())
    stop.details["description"] = state_.breakpoints.name_of(verdict.outcome.stopped.front());
  return stop;
}

static bool has_same_frame(const execution::State& a, const execution::State& b) {
  return a.workpiece_origin == b.workpiece_origin && a.face_mounted == b.face_mounted && a.face == b.face;
}

void StopCheck::step_out() { step_out_from_ = state_.debuggee->present().run().state; }

bool StopCheck::ends_step_out() const {
  if (!step_out_from_) return false;
  const auto block = state_.debuggee->next();
  return block && (debuggee::changes_tool(*block) || !has_same_frame(block->state, *step_out_from_));
}

std::optional<Stop> StopCheck::judge_breakpoints() {
  breakpoints::Breakpoints& breakpoints = state_.breakpoints;
  const std::size_t line = state_.debuggee->present().line();
  const std::uint64_t number = state_.debuggee->present().blocks();
  if (!breakpoints.has_line(line) && !breakpoints.has_functions()) return std::nullopt;
  breakpoints::Breakpoints::BreakpointOutcome at_line;
  breakpoints::Breakpoints::BreakpointOutcome at_code;
  if (breakpoints.has_line(line))
    breakpoints.judge_line(state_.moment(), number, breakpoints::RunDirection::Forward, at_line);
  if (breakpoints.has_functions())
    if (const auto block = state_.debuggee->next())
      breakpoints.judge_functions(block->tree, state_.moment(), number, breakpoints::RunDirection::Forward, at_code);
  report_messages(at_line, line);
  report_messages(at_code, line);
  if (at_line.stopped.empty() && at_code.stopped.empty()) return std::nullopt;
  const std::string_view reason = at_line.stopped.empty() ? "function breakpoint" : "breakpoint";
  at_line.stopped.insert(at_line.stopped.end(), at_code.stopped.begin(), at_code.stopped.end());
  return Stop{.reason = reason, .details = {{"hitBreakpointIds", at_line.stopped}}};
}

std::optional<Stop> StopCheck::judge_exceptions() {
  auto found = find_exception();
  if (!found) found = find_coming_overtravel();
  if (!found) return std::nullopt;
  return stop_at(std::move(*found));
}

Stop StopCheck::stop_at(breakpoints::Exception exception) {
  state_.exception = std::move(exception);
  return {.reason = "exception",
          .details = {{"text", state_.exception->code}, {"description", state_.exception->message}}};
}

std::optional<breakpoints::Exception> StopCheck::find_exception() const {
  if (!state_.exception_filters.judge_blocks()) return std::nullopt;
  const auto block = state_.debuggee->next();
  if (!block) return std::nullopt;
  return state_.exception_filters.find_exception(*block, state_.moment(), state_.debuggee->setup(), state_.language());
}

/// Looks where the machine would really go, which the block alone does not tell.
std::optional<breakpoints::Exception> StopCheck::find_coming_overtravel() const {
  const debuggee::Debuggee& debuggee = *state_.debuggee;
  std::optional<breakpoints::Exception> found;
  if (!state_.exception_filters.judge_motions(debuggee.machine())) return found;
  simulation::Simulation ahead = debuggee.present();
  ahead.trace_block([&](const kinematics::Move& move) {
    const bool is_in_inches = ahead.run().state.in_inches();
    if (!found) found = breakpoints::find_overtravel(move, debuggee.machine(), is_in_inches, state_.language());
  });
  return found;
}

void StopCheck::start_block() {
  const breakpoints::Breakpoints& breakpoints = state_.breakpoints;
  if (!breakpoints.has_data()) return;
  const expressions::Moment before = state_.moment();
  breakpoints.start_trail(before, trail_);
  if (!breakpoints.has_thresholds()) return;
  const auto block = state_.debuggee->next();
  if (block && debuggee::may_be_arc(*block))
    breakpoints.read_arc(debuggee::effect_of(*block, state_.debuggee->setup()), before, trail_);
}

std::optional<Stop> StopCheck::after_block(std::uint64_t block) {
  breakpoints::Breakpoints& breakpoints = state_.breakpoints;
  if (!breakpoints.has_data() || state_.launch_options.no_debug) return std::nullopt;
  const expressions::Moment now = state_.moment();
  breakpoints.read_data(now, trail_);
  breakpoints::Breakpoints::BreakpointOutcome outcome;
  breakpoints.judge_data(trail_, now, block, breakpoints::RunDirection::Forward, outcome);
  report_messages(outcome, now.line);
  if (outcome.stopped.empty()) return std::nullopt;
  return Stop{.reason = "data breakpoint",
              .details = {{"hitBreakpointIds", outcome.stopped},
                          {"description", breakpoints.description(outcome.stopped.front(), trail_)}}};
}

Stop StopCheck::at_error() {
  const running::RunResult& run = state_.debuggee->present().run();
  const dialect::Language language = state_.language();
  return stop_at({.filter = breakpoints::ExceptionFilter::Errors,
                  .code = std::string(dialect::definition(run.error.id).code),
                  .message = running::error_message(run, language),
                  .explanation = analyzer::explain(run.error.id, language)});
}

void StopCheck::report_messages(const breakpoints::Breakpoints::BreakpointOutcome& outcome, std::size_t line) {
  notifier_.report_messages(outcome, line);
  message_count_ += outcome.messages.size();
}

}  // namespace isocnc::session
