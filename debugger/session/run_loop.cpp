#include "debugger/session/run_loop.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "debugger/session/launch.h"
#include "interpreter/running/error_message.h"

namespace isocnc::session {

using dialect::Text;
using namespace std::chrono_literals;

/// A pause waits for one slice at most.
static constexpr auto kSlice = 4ms;
/// Between two slices of a run that keeps pace with the clock.
static constexpr auto kPace = 8ms;
/// Between two looks at a comparison, which has a thread of its own.
static constexpr auto kProgress = 100ms;
/// Messages of log points in a slice, after which the run waits for the client.
static constexpr std::size_t kMaxMessages = 16;

static constexpr Text kNotLedThere{"the run does not lead to line {}", "l'esecuzione non passa dalla riga {}"};
static constexpr Text kProgramEnd{"end of program after {} blocks, {} s", "fine programma dopo {} blocchi, {} s"};
static constexpr Text kGoingTo{"Going to line {}", "Verso la riga {}"};
static constexpr Text kSearching{"Searching back", "Ricerca all'indietro"};
static constexpr Text kComparison{"Comparing the programs", "Confronto dei programmi"};

RunLoop::RunLoop(rpc::Loop& loop, SessionState& state, Notifier& notifier)
    : loop_(loop),
      state_(state),
      notifier_(notifier),
      stop_check_(state, notifier),
      program_check_(loop, state),
      difference_search_(loop) {}

void RunLoop::reset(const debuggee::FileWatch& file) {
  ++generation_;
  activity_ = Activity::None;
  file_watch_ = file;
  origin_.reset();
  has_started_ = false;
  stop_check_.expect_judgement();
  program_check_.forget();
  difference_search_.forget();
}

void RunLoop::start_program() {
  if (std::exchange(has_started_, true)) return;
  program_check_.start_if_needed();
  post([this] { begin_program(); });
}

/// Waits for the checker first.
void RunLoop::begin_program() {
  if (program_check_.is_running()) {
    const auto again = [this, generation = generation_] {
      if (generation == generation_ && state_.is_launched()) begin_program();
    };
    return loop_.post_at(Clock::now() + kPace, again);
  }
  const LaunchOptions& options = state_.launch_options;
  if (options.start_line) return go_forward_to_line(*options.start_line, {.reason = "entry"});
  const auto due = stop_check_.on_arrival();
  if (options.stop_on_entry && !options.no_debug) return stop({.reason = "entry"});
  if (due) return stop(*due);
  start(Activity::Running);
}

// --- Slices

/// Leaves a task that is void when something else has been started meanwhile. The debuggee counts as running until it
/// is done.
void RunLoop::post(const std::function<void()>& task) {
  activity_ = Activity::Running;
  loop_.post([this, task, generation = ++generation_] {
    if (generation == generation_ && state_.is_launched()) task();
  });
}

void RunLoop::start(Activity activity) {
  activity_ = activity;
  notifier_.start_progress();
  restart_pace();
  if (activity != Activity::Running) stop_check_.forget_step_out();
  program_check_.start_if_needed();
  ++generation_;
  schedule();
}

void RunLoop::schedule(std::chrono::milliseconds delay) {
  const auto task = [this, generation = generation_] {
    if (generation == generation_) run_slice();
  };
  if (delay == std::chrono::milliseconds::zero()) return loop_.post(task);
  loop_.post_at(Clock::now() + delay, task);
}

void RunLoop::run_slice() {
  if (!state_.is_launched()) return;
  if (program_check_.is_running()) return schedule(kPace);
  const auto deadline = Clock::now() + kSlice;
  switch (activity_) {
    case Activity::None:
      return;
    case Activity::Running:
      return run_forward(deadline);
    case Activity::RunningBack:
      return run_backward(deadline);
    case Activity::GoingToLine:
      return run_to_line(deadline);
    case Activity::Comparing:
      notifier_.report_progress(std::string(state_.in_language(kComparison)), 0);
      return schedule(kProgress);
  }
}

void RunLoop::restart_pace() { pace_.restart(state_.debuggee->present().time()); }

// --- Forward

void RunLoop::resume() {
  state_.exception.reset();
  post([this] {
    const simulation::Simulation& present = state_.debuggee->present();
    if (present.has_ended()) return finish(present.run().ending == running::Ending::Error ? 1 : 0);
    stop_check_.on_arrival();
    start(Activity::Running);
  });
}

void RunLoop::run_forward(Clock::time_point deadline) {
  constexpr int kBlocksBetweenLooks = 16;
  const double until = pace_.due_time(state_.launch_options.speed);
  stop_check_.reset_message_count();
  do {
    for (int i = 0; i < kBlocksBetweenLooks; ++i) {
      if (state_.debuggee->present().time() >= until || stop_check_.message_count() >= kMaxMessages) {
        report_on_the_way();
        return schedule(kPace);
      }
      if (const auto due = run_block(until)) return stop(*due);
      if (!is_running()) return;
    }
  } while (Clock::now() < deadline);
  if (state_.launch_options.speed > 0) restart_pace();  // A machine that falls behind does not try to catch up.
  report_on_the_way();
  schedule();
}

/// One block, or less of it, up to that moment of the program. A stop that comes of it; the program may have ended,
/// too.
std::optional<Stop> RunLoop::run_block(double until) {
  if (auto due = stop_check_.before_block()) return due;
  const auto moment = stop_check_.next_moment();
  const bool is_due = moment && *moment <= until;
  const std::uint64_t block = advance([&](debuggee::Debuggee& debuggee) {
    is_due ? debuggee.advance_to_moment(*moment) : debuggee.advance_in_block(until);
  });
  if (is_due)
    if (auto due = stop_check_.at_moment()) return due;
  if (state_.debuggee->present().is_in_block()) return std::nullopt;
  return end_block(block);
}

/// Lets the machine move within one block, and reports what that block does where it begins. The number of the block.
std::uint64_t RunLoop::advance(const std::function<void(debuggee::Debuggee& debuggee)>& move) {
  const simulation::Simulation& before = state_.debuggee->present();
  const std::uint64_t block = before.blocks();
  if (before.is_in_block()) {
    move(*state_.debuggee);
    return block - 1;
  }
  const std::size_t line = before.line();
  stop_check_.start_block();
  const debuggee::Journal::ModesAndValues from(before.run());
  move(*state_.debuggee);
  const simulation::Simulation& after = state_.debuggee->present();
  state_.journal.take(block, line, from, debuggee::Journal::ModesAndValues(after.run()), after.runner().events());
  notifier_.report_events(after.runner().events());
  return block;
}

/// The block is over: the program has ended, or there may be a stop.
std::optional<Stop> RunLoop::end_block(std::uint64_t block) {
  const simulation::Simulation& present = state_.debuggee->present();
  if (!present.has_ended()) return stop_check_.after_block(block);
  if (present.run().ending != running::Ending::Error) {
    finish(0);
    return std::nullopt;
  }
  const bool stops =
      state_.exception_filters.is_on(breakpoints::ExceptionFilter::Errors) && !state_.launch_options.no_debug;
  if (stops) return stop_check_.at_error();
  end_at_error();
  return std::nullopt;
}

void RunLoop::end_at_error() {
  const running::RunResult& run = state_.debuggee->present().run();
  const std::string_view code = dialect::definition(run.error.id).code;
  notifier_.report_output("stderr", fmt::format("{}: {}", code, running::error_message(run, state_.language())),
                          run.line);
  finish(1);
}

void RunLoop::step(dap::Step step) {
  state_.exception.reset();
  if (state_.debuggee->present().has_ended()) return resume();
  stop_check_.on_arrival();
  post([this, step] { step_now(step); });
}

void RunLoop::step_now(dap::Step step) {
  const bool is_block = step == dap::Step::Block;
  const auto moment = stop_check_.next_moment();
  const bool is_due = moment && (is_block || *moment <= state_.debuggee->end_of_instruction());
  const std::uint64_t block = advance([&](debuggee::Debuggee& debuggee) {
    if (is_due) return debuggee.advance_to_moment(*moment);
    is_block ? debuggee.step_block() : debuggee.step_instruction();
  });
  if (is_due) {
    if (const auto due = stop_check_.at_moment()) return stop(*due);
    if (state_.debuggee->present().is_in_block()) return step_now(step);
  }
  stop_check_.expect_judgement();
  if (state_.debuggee->present().is_in_block()) return stop({.reason = "step"});
  if (const auto due = end_block(block)) return stop(*due);
  if (state_.is_launched()) settle({.reason = "step"});
}

void RunLoop::step_out() {
  state_.exception.reset();
  if (state_.debuggee->present().has_ended()) return resume();
  stop_check_.on_arrival();
  post([this] {
    start(Activity::Running);
    stop_check_.step_out();
  });
}

// --- To a line

void RunLoop::go_to_line(std::size_t line) { go_to_line(line, {.reason = "goto"}); }

void RunLoop::go_to_line(std::size_t line, const Stop& arrival) {
  const simulation::Simulation& present = state_.debuggee->present();
  const bool is_within = present.is_in_block() || present.has_ended();
  const bool is_past = line < present.line() || (line == present.line() && is_within);
  if (!is_past) return go_forward_to_line(line, arrival);
  post([this, line, arrival] { go_backward_to_line(line, arrival); });
}

void RunLoop::go_backward_to_line(std::size_t line, const Stop& arrival) {
  if (const auto block = state_.debuggee->find_line(line)) {
    state_.exception.reset();
    move_back([&](debuggee::Debuggee& debuggee) { debuggee.go_to_block(*block); });
  } else {
    report_missed_line(line);
  }
  settle(arrival);
}

void RunLoop::go_forward_to_line(std::size_t line, const Stop& arrival) {
  state_.exception.reset();
  arrival_ = arrival;
  target_line_ = line;
  origin_ = state_.debuggee->present();
  state_.debuggee->skip_to_line(line);
  start(Activity::GoingToLine);
}

void RunLoop::run_to_line(Clock::time_point deadline) {
  do {
    if (!pass_block()) return arrive_at_line();
  } while (Clock::now() < deadline);
  const double lines = static_cast<double>(std::max<std::size_t>(target_line_, 1));
  const auto title = state_.in_language(kGoingTo, state_.client.to_client_line(target_line_));
  notifier_.report_progress(title, static_cast<double>(state_.debuggee->present().line()) / lines);
  notifier_.report_running_position();
  schedule();
}

/// One block on the path to the line. False where the run has come to the line, past it, or to the end.
bool RunLoop::pass_block() {
  const simulation::Simulation& present = state_.debuggee->present();
  const bool is_in_block = present.is_in_block();
  const std::uint64_t block = present.blocks();
  const std::size_t line = present.line();
  if (present.has_ended() || (!is_in_block && line >= target_line_)) return false;
  const debuggee::Journal::ModesAndValues from(present.run());
  state_.debuggee->step_block();
  if (!is_in_block)
    state_.journal.take(block, line, from, debuggee::Journal::ModesAndValues(present.run()), present.runner().events());
  return true;
}

/// The run goes back to where it began where it does not lead to the line.
void RunLoop::arrive_at_line() {
  const simulation::Simulation& present = state_.debuggee->present();
  const bool is_there = !present.has_ended() && present.line() == target_line_;
  if (!is_there) report_missed_line(target_line_, present.line());
  if (present.has_ended() && present.run().ending == running::Ending::Error) return stop(stop_check_.at_error());
  if (!is_there) state_.debuggee->return_to(*origin_);
  settle(arrival_);
}

void RunLoop::report_missed_line(std::size_t line, std::optional<std::uint64_t> place) {
  notifier_.report_output("important", state_.in_language(kNotLedThere, state_.client.to_client_line(line)), place);
}

// --- To a difference

void RunLoop::run_to_difference(difference::ReferenceProgram reference) {
  notifier_.report_resumption();
  start(Activity::Comparing);
  const difference::ReferenceComparison comparison{.debuggee = state_.debuggee,
                                                   .options = run_options(state_.launch_options, state_.configuration),
                                                   .machine = state_.configuration.machine.timed,
                                                   .reference = std::move(reference),
                                                   .language = state_.language()};
  difference_search_.start(comparison, [this, generation = generation_](const difference::FirstDifference& found) {
    if (generation == generation_ && state_.is_launched()) take_difference(found);
  });
}

void RunLoop::take_difference(const difference::FirstDifference& found) {
  const Stop arrival{.reason = "difference", .details = {{"description", found.text}}};
  notifier_.report_output(found.line ? "console" : "important", found.text, found.line);
  if (found.line) return go_to_line(*found.line, arrival);
  stop(arrival);
}

// --- Backward

void RunLoop::reverse() {
  state_.exception.reset();
  search_.emplace(state_);
  start(Activity::RunningBack);
}

void RunLoop::run_backward(Clock::time_point deadline) {
  do {
    if (const auto hit = search_->search_window()) return go_back_to(*hit);
    if (search_->is_exhausted()) return go_back_to_start();
  } while (Clock::now() < deadline);
  notifier_.report_progress(std::string(state_.in_language(kSearching)), search_->part_searched());
  schedule();
}

void RunLoop::go_back_to(const BackwardSearch::Hit& hit) {
  move_back([&](debuggee::Debuggee& debuggee) {
    debuggee.go_to_block(hit.block);
    if (hit.moment) debuggee.advance_to_moment(hit.moment->time);
  });
  stop_check_.expect_judgement();
  state_.exception.reset();
  if (hit.moment) return stop(stop_check_.at_moment(*hit.moment, hit.block));
  const auto due = stop_check_.on_arrival();
  if (hit.is_change) return stop({.reason = "data breakpoint"});
  stop(due ? *due : Stop{.reason = "breakpoint"});
}

void RunLoop::go_back_to_start() {
  move_back([](debuggee::Debuggee& debuggee) {
    debuggee.go_to_block(0);
    while (!debuggee.is_at_start()) debuggee.step_back();
  });
  settle({.reason = "entry"});
}

void RunLoop::step_back(dap::Step step) {
  state_.exception.reset();
  post([this, step] {
    move_back([step](debuggee::Debuggee& debuggee) {
      step == dap::Step::Block ? debuggee.step_back() : debuggee.step_instruction_back();
    });
    stop_check_.skip_judgement();  // The run forward has judged it.
    stop({.reason = "step"});
  });
}

/// A change by hand that the run goes back over is undone, and what has come of it is forgotten.
void RunLoop::move_back(const std::function<void(debuggee::Debuggee& debuggee)>& move) {
  const std::size_t changes = state_.debuggee->change_count();
  move(*state_.debuggee);
  if (state_.debuggee->change_count() != changes) forget_future();
}

void RunLoop::forget_future() {
  const std::uint64_t block = state_.debuggee->present().blocks();
  state_.journal.forget_from(block);
  state_.breakpoints.forget_hits_from(block + 1);
  state_.surroundings->forget_from(block);
}

// --- Stops

void RunLoop::pause() {
  if (!is_running()) return;
  ++generation_;
  difference_search_.forget();
  loop_.post([this, generation = generation_] {
    if (generation != generation_ || !state_.is_launched()) return;
    if (state_.debuggee->present().has_ended()) return finish(1);
    stop_check_.on_arrival();
    state_.exception.reset();
    stop({.reason = "pause"});
  });
}

void RunLoop::stop(const Stop& stop) {
  notifier_.end_progress();
  activity_ = Activity::None;
  stop_check_.forget_step_out();
  origin_.reset();
  notifier_.report_standing_position();
  notifier_.report_omissions();
  if (const auto change = file_watch_.find_change()) notifier_.report_file_change(*change);
  notifier_.report_stop(stop.reason, stop.details);
}

/// The run stands where it was led. What is due there counts after a step.
void RunLoop::settle(const Stop& arrival) {
  stop_check_.expect_judgement();
  const auto due = stop_check_.on_arrival();
  stop(due && arrival.reason == "step" ? *due : arrival);
}

void RunLoop::end_later(int exit_code) {
  loop_.post([this, exit_code] { finish(exit_code); });
}

void RunLoop::finish(int exit_code) {
  notifier_.end_progress();
  ++generation_;
  difference_search_.forget();
  const bool has_run = std::exchange(activity_, Activity::None) != Activity::None;
  if (!state_.is_launched()) return;
  const simulation::Simulation& present = state_.debuggee->present();
  notifier_.report_omissions();
  if (has_run && present.has_ended() && exit_code == 0) {
    const std::string seconds = expressions::show_value(present.time(), {.decimals = 1});
    notifier_.report_output("console", state_.in_language(kProgramEnd, present.blocks(), seconds), present.line());
  }
  notifier_.report_standing_position();
  state_.debuggee.reset();
  notifier_.report_exit(exit_code);
}

void RunLoop::abandon() {
  ++generation_;
  difference_search_.forget();
  activity_ = Activity::None;
  state_.debuggee.reset();
}

void RunLoop::report_on_the_way() {
  notifier_.report_running_position();
  if (const auto change = file_watch_.find_change_now_and_then()) notifier_.report_file_change(*change);
}

}  // namespace isocnc::session
