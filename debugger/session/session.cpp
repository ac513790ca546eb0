#include "debugger/session/session.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "analyzer/check/check_text.h"
#include "analyzer/explain.h"
#include "analyzer/selection/program_settings.h"
#include "analyzer/selection/shown_report.h"
#include "debugger/session/block_effect.h"
#include "interpreter/dialect/locale.h"
#include "interpreter/motion/numbers.h"
#include "interpreter/running/error_message.h"
#include "interpreter/system/same_file.h"

namespace isocnc::debugger::session {

using dialect::Language;
using dialect::Text;
using namespace std::chrono_literals;

/// A pause waits for a slice at most.
static constexpr auto kSlice = 4ms;
/// Between two slices of a run that keeps pace with the clock.
static constexpr auto kPace = 8ms;
/// 60 a second.
static constexpr auto kBetweenPositions = 16667us;
/// Whoever searches for longer is told how far it has come, so often.
static constexpr auto kPatience = 500ms;
static constexpr auto kBetweenProgress = 200ms;
/// Blocks that are searched at once on the way back.
static constexpr std::uint64_t kWindow = 8192;
/// How often it is looked whether the file has changed.
static constexpr auto kBetweenLooks = 1000ms;
/// More than anybody reads in a second.
static constexpr std::size_t kMostOutputs = 200;
static constexpr auto kOutputSecond = 1000ms;
/// Of log points, in a slice; then a pause of kPace.
static constexpr std::size_t kMostMessages = 16;

static constexpr Text kNotLaunched{"no program has been launched", "nessun programma è stato avviato"};
static constexpr Text kLaunchedAlready{"a program has been launched already", "un programma è già stato avviato"};
static constexpr Text kIsRunning{"the program is running: pause it first",
                                 "il programma è in esecuzione: prima va messo in pausa"};
static constexpr Text kInBlock{"the machine is within a block: step to its end first",
                               "la macchina è dentro un blocco: prima va portata alla fine del blocco"};
static constexpr Text kCompensation{"G41 or G42 is in force: nothing can be changed by hand before G40",
                                    "G41 o G42 è in presa: prima di G40 non si può intervenire a mano"};
static constexpr Text kHasEnded{"the program has ended: step back first",
                                "il programma è terminato: prima tornare indietro"};
static constexpr Text kNotSettable{"{} cannot be set", "{} non si può impostare"};
static constexpr Text kBadValue{"{} cannot be {}", "{} non può essere {}"};
static constexpr Text kNotLedThere{"the run does not lead to line {}", "l'esecuzione non passa dalla riga {}"};
static constexpr Text kProgramEnd{"end of program after {} blocks, {} s", "fine programma dopo {} blocchi, {} s"};
static constexpr Text kFileChanged{"the file of the program has changed: restart to debug what it says now",
                                   "il file del programma è cambiato: riavviare per eseguire il nuovo testo"};
static constexpr Text kUntold{"{} more messages are left out", "altri {} messaggi omessi"};
static constexpr Text kGoingTo{"Going to line {}", "Verso la riga {}"};
static constexpr Text kSearching{"Searching back", "Ricerca all'indietro"};
static constexpr Text kToolChange{"tool change: {}", "cambio utensile: {}"};
static constexpr Text kSpindleSpeed{"spindle speed: S{}", "velocità mandrino: S{}"};
static constexpr Text kUpdate{"G990: technological parameters are read anew",
                              "G990: aggiornamento della parametrica tecnologica"};
static constexpr Text kDone{"done", "eseguito"};

Session::Session(lsp::rpc::Loop& loop, Emit emit, std::optional<Language> language)
    : loop_(loop), emit_(std::move(emit)), commanded_(language) {}

Language Session::language() const {
  if (commanded_) return *commanded_;
  if (configuration_.language) return *configuration_.language;
  return client.locale.value_or(dialect::language_of_environment());
}

// --- Lifecycle

void Session::launch(LaunchWishes wishes) {
  if (is_launched()) throw RequestError(std::string(in_language(kLaunchedAlready)));
  begin(std::move(wishes));
  if (wishes_.break_on_warnings) watchmen.on[static_cast<std::size_t>(Watch::Warnings)] = true;
}

void Session::begin(LaunchWishes wishes) {
  std::error_code error;
  const auto file_time = std::filesystem::last_write_time(wishes.program, error);  // Before it is read.
  Launched launched = session::launch(wishes, commanded_, client.locale.value_or(dialect::language_of_environment()));
  wishes_ = std::move(wishes);
  configuration_ = std::move(launched.configuration);
  debuggee_ = std::make_shared<Debuggee>(std::move(launched.debuggee));
  journal_ = {};
  origin_.reset();
  exception_.reset();
  has_begun_ = false;
  has_arrived_ = false;
  is_checked_ = false;
  watchmen.warnings.clear();
  breakpoints.forget_hits_from(0);
  file_time_ = error ? std::nullopt : std::optional(file_time);
  has_told_of_file_ = false;
  tell_of_moved_breakpoints();
}

void Session::configuration_done() {
  if (!is_launched()) throw RequestError(std::string(in_language(kNotLaunched)));
  if (std::exchange(has_begun_, true)) return;
  is_configured_ = true;
  activity_ = Activity::Running;
  check_for_warnings();
  loop_.post([this, generation = ++generation_] { begin_run(generation); });
}

/// Stands at the begin, or goes to where the run is to start, as soon as the checker is done.
void Session::begin_run(std::uint64_t generation) {
  if (generation != generation_ || !is_launched()) return;
  if (is_checking_) return loop_.post_at(Clock::now() + kPace, [this, generation] { begin_run(generation); });
  if (wishes_.start_line) return go_on_to_line(*wishes_.start_line, "entry");
  const auto reached = arrive();
  if (wishes_.stop_on_entry && !wishes_.no_debug) return stop({.reason = "entry"});
  if (reached) return stop(*reached);
  start(Activity::Running);
}

void Session::restart(std::optional<LaunchWishes> wishes) {
  if (!is_launched()) throw RequestError(std::string(in_language(kNotLaunched)));
  begin(wishes ? std::move(*wishes) : wishes_);
  end_progress();
  activity_ = Activity::None;
  ++generation_;
  if (is_configured_) configuration_done();
}

void Session::terminate() {
  if (!is_launched()) throw RequestError(std::string(in_language(kNotLaunched)));
  loop_.post([this] { finish(0); });
}

void Session::abandon() {
  ++generation_;
  activity_ = Activity::None;
  debuggee_.reset();
}

const Debuggee& Session::debuggee() const {
  if (!is_launched()) throw RequestError(std::string(in_language(kNotLaunched)));
  return *debuggee_;
}

Debuggee& Session::standing() const {
  if (!is_launched()) throw RequestError(std::string(in_language(kNotLaunched)));
  if (is_running()) throw RequestError(std::string(in_language(kIsRunning)));
  return *debuggee_;
}

Moment Session::moment() const {
  Moment moment = moment_of(debuggee().present());
  moment.override_percent = 100 * debuggee().feed_override();
  moment.playback = wishes_.speed;
  return moment;
}

// --- Running

void Session::start(Activity activity) {
  activity_ = activity;
  activity_begin_ = last_progress_ = pace_begin_ = Clock::now();
  pace_time_ = debuggee_->present().time();
  if (activity != Activity::Running) step_out_of_.reset();
  check_for_warnings();
  ++generation_;
  schedule();
}

void Session::schedule(std::chrono::milliseconds delay) {
  const auto task = [this, generation = generation_] {
    if (generation == generation_) run_slice();
  };
  if (delay == std::chrono::milliseconds::zero()) return loop_.post(task);
  loop_.post_at(Clock::now() + delay, task);
}

void Session::run_slice() {
  if (!is_launched()) return;
  if (is_checking_) return schedule(kPace);
  const auto deadline = Clock::now() + kSlice;
  switch (activity_) {
    case Activity::None:
      return;
    case Activity::Running:
      return run_on(deadline);
    case Activity::RunningBack:
      return run_back(deadline);
    case Activity::GoingOn:
      return run_to_line(deadline);
  }
}

/// Where the machine should be by now: the end of time, unless it keeps pace with the clock. A machine that cannot
/// does not try to make up for it.
double Session::next_moment() {
  if (!(wishes_.speed > 0)) return std::numeric_limits<double>::infinity();
  const std::chrono::duration<double> passed = Clock::now() - pace_begin_;
  return pace_time_ + passed.count() * wishes_.speed;
}

void Session::run_on(Clock::time_point deadline) {
  constexpr int kBlocksBetweenLooks = 16;
  const double until = next_moment();
  messages_ = 0;
  do {
    for (int i = 0; i < kBlocksBetweenLooks; ++i) {
      if (debuggee_->present().time() >= until || messages_ >= kMostMessages) {
        tell_where_it_is();
        return schedule(kPace);
      }
      if (const auto due = go_on_one_block(until)) return stop(*due);
      if (!is_running()) return;
    }
  } while (Clock::now() < deadline);
  if (wishes_.speed > 0) {
    pace_begin_ = Clock::now();
    pace_time_ = debuggee_->present().time();
  }
  tell_where_it_is();
  schedule();
}

/// Lets the machine go on within one block, and tells what that block does where it begins. Its number.
template <class Move>
std::uint64_t Session::advance(const Move& move) {
  const simulation::Simulation& present = debuggee_->present();
  const std::uint64_t block = present.blocks();
  const std::uint64_t line = present.line();
  if (present.is_in_block()) {
    move(*debuggee_);
    return block - 1;
  }
  begin_trail();
  const Journal::Modes modes(present.run().state);
  move(*debuggee_);
  const simulation::Simulation& behind = debuggee_->present();
  journal_.take(block, line, modes, Journal::Modes(behind.run().state), behind.runner().events());
  tell_events(behind.runner().events());
  return block;
}

/// One block, or less of it. What comes of it: a stop, the end of the run, or nothing.
std::optional<Session::Stop> Session::go_on_one_block(double until) {
  Debuggee& debuggee = *debuggee_;
  if (!debuggee.present().is_in_block() && !std::exchange(has_arrived_, false))
    if (auto due = look_at_block(debuggee)) {
      has_arrived_ = true;
      return due;
    }
  const std::uint64_t block = advance([until](Debuggee& moved) { moved.advance_in_block(until); });
  if (debuggee.present().is_in_block()) return std::nullopt;
  return end_block(block);
}

/// Values along an arc: what only goes beyond a threshold and comes back shows there alone.
static void follow_arc(const Breakpoints& breakpoints, const BlockEffect& effect, const Moment& behind, Trail& trail) {
  if (effect.has_error) return;
  execution::State state = effect.state;
  for (const geometry::Pose& point : effect.on_arc) {
    state.position = point;
    breakpoints.read_data({.state = state,
                           .registers = effect.registers,
                           .vgpl = behind.vgpl,
                           .line = behind.line,
                           .override_percent = behind.override_percent,
                           .playback = behind.playback},
                          trail);
  }
}

void Session::begin_trail() {
  if (!breakpoints.has_data()) return;
  const Moment before = moment();
  breakpoints.begin_trail(before, trail_);
  if (!breakpoints.has_thresholds()) return;
  const auto block = debuggee_->next();
  if (block && may_be_arc(*block)) follow_arc(breakpoints, effect_of(*block, debuggee_->setup()), before, trail_);
}

/// The block is over: has the program ended, or has something become what somebody waits for?
std::optional<Session::Stop> Session::end_block(std::uint64_t block) {
  const simulation::Simulation& present = debuggee_->present();
  if (present.has_ended()) {
    if (present.run().ending != running::Ending::Error) {
      finish(0);
      return std::nullopt;
    }
    if (watchmen.is_on(Watch::Errors) && !wishes_.no_debug) return failure();
    const running::RunResult& run = present.run();
    tell_output("stderr",
                fmt::format("{}: {}", dialect::definition(run.error.id).code, running::error_message(run, language())),
                run.line);
    finish(1);
    return std::nullopt;
  }
  if (!breakpoints.has_data() || wishes_.no_debug) return std::nullopt;
  breakpoints.read_data(moment(), trail_);
  Breakpoints::Outcome outcome;
  breakpoints.look_at_data(trail_, moment(), block, Breakpoints::Way::On, outcome);
  tell_messages(outcome, present.line());
  if (outcome.stopped.empty()) return std::nullopt;
  return Stop{.reason = "data breakpoint",
              .more = {{"hitBreakpointIds", outcome.stopped},
                       {"description", breakpoints.description(outcome.stopped.front(), trail_)}}};
}

static bool has_same_frame(const execution::State& a, const execution::State& b) {
  return a.workpiece_origin == b.workpiece_origin && a.face_mounted == b.face_mounted && a.face == b.face;
}

/// What stands before the next block.
std::optional<Session::Stop> Session::look_at_block(Debuggee& debuggee) {
  if (wishes_.no_debug || debuggee.present().has_ended()) return std::nullopt;
  if (step_out_of_) {
    const auto block = debuggee.next();
    if (block && (changes_tool(*block) || !has_same_frame(block->state, *step_out_of_))) return Stop{.reason = "step"};
  }
  const std::uint64_t line = debuggee.present().line();
  if (breakpoints.has_line(line) || breakpoints.has_functions())
    if (auto hit = look_at_breakpoints(debuggee)) return hit;
  if (!watchmen.looks_at_blocks()) return std::nullopt;
  const auto block = debuggee.next();
  if (!block) return std::nullopt;
  auto found = watchmen.look_at(*block, debuggee.setup(), debuggee.machine(), language());
  if (!found) return std::nullopt;
  exception_ = std::move(found);
  return Stop{.reason = "exception", .more = {{"text", exception_->code}, {"description", exception_->message}}};
}

std::optional<Session::Stop> Session::look_at_breakpoints(Debuggee& debuggee) {
  const std::uint64_t line = debuggee.present().line();
  const std::uint64_t number = debuggee.present().blocks();
  Breakpoints::Outcome at_line;
  Breakpoints::Outcome at_code;
  if (breakpoints.has_line(line)) breakpoints.look_at_line(moment(), number, Breakpoints::Way::On, at_line);
  if (breakpoints.has_functions())
    if (const auto block = debuggee.next())
      breakpoints.look_at_functions(block->tree, moment(), number, Breakpoints::Way::On, at_code);
  tell_messages(at_line, line);
  tell_messages(at_code, line);
  if (at_line.stopped.empty() && at_code.stopped.empty()) return std::nullopt;
  const std::string_view reason = at_line.stopped.empty() ? "function breakpoint" : "breakpoint";
  at_line.stopped.insert(at_line.stopped.end(), at_code.stopped.begin(), at_code.stopped.end());
  return Stop{.reason = reason, .more = {{"hitBreakpointIds", at_line.stopped}}};
}

/// Looks at the block that the run stands before, unless it has been looked at.
std::optional<Session::Stop> Session::arrive() {
  if (debuggee_->present().is_in_block() || std::exchange(has_arrived_, true)) return std::nullopt;
  return look_at_block(*debuggee_);
}

Session::Stop Session::failure() {
  const running::RunResult& run = debuggee_->present().run();
  const std::string code(dialect::definition(run.error.id).code);
  exception_ = Exception{Watch::Errors, code, running::error_message(run, language()),
                         analyzer::explain(run.error.id, language())};
  return {.reason = "exception", .more = {{"text", code}, {"description", exception_->message}}};
}

void Session::stop(const Stop& stop) {
  end_progress();
  activity_ = Activity::None;
  step_out_of_.reset();
  origin_.reset();
  tell_position(true);
  tell_untold();
  tell_of_changed_file();
  tell_stop(stop.reason, stop.more);
}

/// The run stands where it was led: what is there counts, too.
void Session::settle(std::string_view reason) {
  has_arrived_ = false;
  const auto reached = arrive();
  if (reached && reason == "step") return stop(*reached);
  stop({.reason = reason});
}

void Session::finish(int exit_code) {
  end_progress();
  ++generation_;
  const bool has_run = std::exchange(activity_, Activity::None) != Activity::None;
  if (!is_launched()) return;
  const simulation::Simulation& present = debuggee_->present();
  tell_untold();
  if (has_run && present.has_ended() && exit_code == 0)
    tell_output("console", in_language(kProgramEnd, present.blocks(), show_value(present.time(), {.decimals = 1})),
                present.line());
  tell_position(true);
  debuggee_.reset();
  emit_("exited", {{"exitCode", exit_code}});
  emit_("terminated", Json::object());
}

void Session::go_on() {
  Debuggee& debuggee = standing();
  exception_.reset();
  loop_.post([this, generation = ++generation_, has_ended = debuggee.present().has_ended()] {
    if (generation != generation_ || !is_launched()) return;
    if (has_ended) return finish(debuggee_->present().run().ending == running::Ending::Error ? 1 : 0);
    arrive();
    start(Activity::Running);
  });
  activity_ = Activity::Running;
}

/// Blocks before this one have begun. Where an error has ended the program, its block counts.
std::uint64_t Session::end_of_past() const {
  const simulation::Simulation& present = debuggee_->present();
  const bool has_failed = present.has_ended() && present.run().ending == running::Ending::Error;
  return present.blocks() + (has_failed ? 1 : 0);
}

void Session::go_back() {
  standing();
  exception_.reset();
  searched_ = search_begin_ = end_of_past();
  start(Activity::RunningBack);
}

/// On the way back a block counts by itself, or by what it changes: then the run stops behind it.
bool Session::is_hit_on_the_way_back(const running::Block& block, std::uint64_t start, bool& is_behind) {
  is_behind = false;
  const Moment before{.state = block.state, .registers = block.registers, .vgpl = block.vgpl, .line = block.line};
  Breakpoints::Outcome outcome;
  if (breakpoints.has_line(block.line)) breakpoints.look_at_line(before, block.number, Breakpoints::Way::Back, outcome);
  if (breakpoints.has_functions())
    breakpoints.look_at_functions(block.tree, before, block.number, Breakpoints::Way::Back, outcome);
  if (breakpoints.has_data() && block.number + 1 < start) {
    const BlockEffect effect = effect_of(block, debuggee_->setup());
    const Moment after{.state = effect.state, .registers = effect.registers, .vgpl = block.vgpl, .line = block.line};
    breakpoints.begin_trail(before, trail_);
    follow_arc(breakpoints, effect, after, trail_);
    breakpoints.read_data(after, trail_);
    Breakpoints::Outcome changes;
    breakpoints.look_at_data(trail_, after, block.number, Breakpoints::Way::Back, changes);
    is_behind = !effect.has_error && !changes.stopped.empty();
  }
  if (is_behind || !outcome.stopped.empty()) return true;
  return watchmen.looks_at_blocks() &&
         watchmen.look_at(block, debuggee_->setup(), debuggee_->machine(), language()).has_value();
}

void Session::run_back(Clock::time_point deadline) {
  do {
    const std::uint64_t from = searched_ > kWindow ? searched_ - kWindow : 0;
    bool is_behind = false;
    const auto found = debuggee_->find_back(from, searched_, [&](const running::Block& block) {
      bool is_behind_this = false;
      if (!is_hit_on_the_way_back(block, search_begin_, is_behind_this)) return false;
      is_behind = is_behind_this;
      return true;
    });
    if (found) {
      lead_back([&](Debuggee& debuggee) { debuggee.go_to_block(*found + (is_behind ? 1 : 0)); });
      has_arrived_ = false;
      exception_.reset();
      const auto reached = arrive();
      return stop(reached && !is_behind ? *reached : Stop{.reason = is_behind ? "data breakpoint" : "breakpoint"});
    }
    searched_ = from;
    if (searched_ == 0) {
      lead_back([](Debuggee& debuggee) {
        debuggee.go_to_block(0);
        while (!debuggee.is_at_begin()) debuggee.step_back();
      });
      return settle("entry");
    }
  } while (Clock::now() < deadline);
  tell_progress(1 - static_cast<double>(searched_) / static_cast<double>(std::max<std::uint64_t>(search_begin_, 1)));
  schedule();
}

void Session::pause() {
  if (!is_launched()) throw RequestError(std::string(in_language(kNotLaunched)));
  if (!is_running()) return;
  ++generation_;
  loop_.post([this, generation = generation_] {
    if (generation != generation_ || !is_launched()) return;
    if (debuggee_->present().has_ended()) return finish(1);
    arrive();
    exception_.reset();
    stop({.reason = "pause"});
  });
}

void Session::step(Step step) {
  Debuggee& debuggee = standing();
  exception_.reset();
  if (debuggee.present().has_ended()) return go_on();
  arrive();
  activity_ = Activity::Running;
  loop_.post([this, step, generation = ++generation_] {
    if (generation != generation_ || !is_launched()) return;
    const std::uint64_t block = advance([step](Debuggee& moved) {
      if (step == Step::Block) {
        moved.step_block();
      } else {
        moved.step_instruction();
      }
    });
    has_arrived_ = false;
    if (debuggee_->present().is_in_block()) return stop({.reason = "step"});
    if (const auto due = end_block(block)) return stop(*due);
    if (is_launched()) settle("step");
  });
}

void Session::step_back(Step step) {
  standing();
  exception_.reset();
  activity_ = Activity::Running;
  loop_.post([this, step, generation = ++generation_] {
    if (generation != generation_ || !is_launched()) return;
    lead_back([step](Debuggee& debuggee) {
      if (step == Step::Block) {
        debuggee.step_back();
      } else {
        debuggee.step_instruction_back();
      }
    });
    has_arrived_ = true;  // What is here has been told on the way on.
    stop({.reason = "step"});
  });
}

void Session::step_out() {
  Debuggee& debuggee = standing();
  exception_.reset();
  if (debuggee.present().has_ended()) return go_on();
  arrive();
  loop_.post([this, generation = ++generation_] {
    if (generation != generation_ || !is_launched()) return;
    start(Activity::Running);
    step_out_of_ = debuggee_->present().run().state;
  });
  activity_ = Activity::Running;
}

void Session::go_to_line(std::uint64_t line) {
  const simulation::Simulation& present = standing().present();
  const bool is_within = present.is_in_block() || present.has_ended();
  const bool is_behind = line < present.line() || (line == present.line() && is_within);
  if (!is_behind) return go_on_to_line(line, "goto");
  activity_ = Activity::Running;
  loop_.post([this, line, generation = ++generation_] {
    if (generation != generation_ || !is_launched()) return;
    if (const auto found = debuggee_->find_line(line)) {
      exception_.reset();
      lead_back([&](Debuggee& debuggee) { debuggee.go_to_block(*found); });
    } else {
      tell_output("important", in_language(kNotLedThere, client.to_client_line(line)));
    }
    settle("goto");
  });
}

void Session::go_on_to_line(std::uint64_t line, std::string_view reason) {
  exception_.reset();
  arrival_reason_ = reason;
  target_line_ = line;
  origin_ = debuggee_->present();
  debuggee_->skip_to_line(line);
  start(Activity::GoingOn);
}

/// On, and nothing on the way is stopped at.
void Session::run_to_line(Clock::time_point deadline) {
  do {
    const simulation::Simulation& present = debuggee_->present();
    const bool is_over = present.has_ended() || (!present.is_in_block() && present.line() >= target_line_);
    if (is_over) {
      const bool is_there = !present.has_ended() && present.line() == target_line_;
      if (!is_there)
        tell_output("important", in_language(kNotLedThere, client.to_client_line(target_line_)), present.line());
      if (present.has_ended() && present.run().ending == running::Ending::Error) return stop(failure());
      if (!is_there) debuggee_->return_to(*origin_);
      return settle(arrival_reason_);
    }
    const std::uint64_t block = present.blocks();
    const std::uint64_t line = present.line();
    const bool begins = !present.is_in_block();
    const Journal::Modes modes(present.run().state);
    debuggee_->step_block();
    if (begins) journal_.take(block, line, modes, Journal::Modes(present.run().state), present.runner().events());
  } while (Clock::now() < deadline);
  const double lines = static_cast<double>(std::max<std::uint64_t>(target_line_, 1));
  tell_progress(static_cast<double>(debuggee_->present().line()) / lines);
  tell_position(false);
  schedule();
}

// --- Breakpoints

const std::vector<Session::LineWish>& Session::set_line_breakpoints(std::vector<LineWish> wishes) {
  line_wishes_ = std::move(wishes);
  place_line_breakpoints();
  return line_wishes_;
}

/// Each on the first line from the wanted one on that does something.
void Session::place_line_breakpoints() {
  std::vector<LineBreakpoint> placed;
  for (LineWish& wish : line_wishes_) {
    wish.line.reset();
    if (!wish.problem.empty()) continue;
    wish.line = debuggee().text().executable_line(wish.wanted);
    if (wish.line) placed.push_back({{.id = wish.id, .rules = wish.rules, .counter = {}}, *wish.line});
  }
  breakpoints.set_lines(std::move(placed), debuggee().text().line_count());
}

/// The program has been read anew.
void Session::tell_of_moved_breakpoints() {
  const std::vector<LineWish> before = line_wishes_;
  place_line_breakpoints();
  for (std::size_t i = 0; i < before.size(); ++i) {
    const LineWish& wish = line_wishes_[i];
    if (wish.line == before[i].line) continue;
    Json breakpoint = {{"id", wish.id}, {"verified", wish.line.has_value()}, {"source", source()}};
    if (wish.line) breakpoint["line"] = client.to_client_line(*wish.line);
    emit_("breakpoint", {{"reason", "changed"}, {"breakpoint", breakpoint}});
  }
}

/// Also when the file is gone meanwhile.
bool Session::is_program(const std::filesystem::path& file) const {
  return file == wishes_.program || system::is_same_file(file.string(), wishes_.program.string());
}

// --- Changing

/// Who goes back over a change undoes it: what has come of it is forgotten.
void Session::lead_back(const std::function<void(Debuggee& debuggee)>& move) {
  const std::size_t changes = debuggee_->change_count();
  move(*debuggee_);
  if (debuggee_->change_count() != changes) forget_from(debuggee_->present().blocks());
}

void Session::forget_from(std::uint64_t block) {
  journal_.forget_from(block);
  breakpoints.forget_hits_from(block + 1);
}

void Session::changed_by_hand() {
  forget_from(debuggee_->present().blocks());
  if (client.takes_invalidated) emit_("invalidated", {{"areas", {"all"}}});
  tell_position(true);
}

void Session::require_no_hindrance() const {
  const auto hindrance = standing().hindrance();
  if (!hindrance) return;
  const Text& why = *hindrance == Hindrance::InBlock        ? kInBlock
                    : *hindrance == Hindrance::Compensation ? kCompensation
                                                            : kHasEnded;
  throw RequestError(std::string(in_language(why)));
}

void Session::set_speed(double speed) {
  wishes_.speed = speed;
  pace_begin_ = Clock::now();
  if (is_launched()) pace_time_ = debuggee_->present().time();
}

bool Session::can_set(const Quantity& quantity) {
  const auto& name = quantity.name;
  return quantity.is_register || name == "VGPL" || name == "S" || name == "F" || name == "OVERRIDE" ||
         name == "PLAYBACK";
}

void Session::refuse_to_set(std::string_view name) const { throw RequestError(in_language(kNotSettable, name)); }

void Session::set_quantity(const Quantity& quantity, double value) {
  Debuggee& debuggee = standing();
  if (!can_set(quantity)) refuse_to_set(quantity.name);
  const bool is_positive = value > 0 || (quantity.name == "PLAYBACK" && value == 0);
  const bool takes_any = quantity.is_register || quantity.name == "VGPL";
  if (!std::isfinite(value) || (!takes_any && !is_positive) || (quantity.name == "OVERRIDE" && value > 1000))
    throw RequestError(in_language(kBadValue, quantity.name, show_value(value)));
  if (quantity.is_register) {
    debuggee.set_register(quantity.index, value);
  } else if (quantity.name == "VGPL") {
    debuggee.set_vgpl(value);
  } else if (quantity.name == "PLAYBACK") {
    return set_speed(value);
  } else {
    require_no_hindrance();
    if (quantity.name == "OVERRIDE") {
      debuggee.set_feed_override(value / 100);
    } else if (quantity.name == "S") {
      debuggee.set_spindle_speed(value);
    } else {
      debuggee.set_feed(value);
    }
  }
  changed_by_hand();
}

std::string Session::run_by_hand(std::string_view text) {
  require_no_hindrance();
  const MdiOutcome outcome = standing().run_by_hand(text);
  if (outcome.error) {
    const running::RunResult& run = *outcome.error;
    throw RequestError(
        fmt::format("{}: {}", dialect::definition(run.error.id).code, running::error_message(run, language())));
  }
  has_arrived_ = true;
  changed_by_hand();
  std::string told;
  for (const running::Event& event : outcome.events)
    if (const std::string line = describe(event); !line.empty()) told += line + "\n";
  const geometry::Pose tip = machine_pose(moment());
  told += fmt::format("{}: XM {} YM {} ZM {} BM {} CM {}", in_language(kDone), show_value(tip.tip.x()),
                      show_value(tip.tip.y()), show_value(tip.tip.z()), show_value(tip.b), show_value(tip.c));
  return told;
}

// --- Telling

Json Session::source() const {
  return {{"name", wishes_.program.filename().string()}, {"path", wishes_.program.string()}};
}

void Session::tell_stop(std::string_view reason, Json more) {
  more["reason"] = reason;
  more["threadId"] = 1;
  more["allThreadsStopped"] = true;
  emit_("stopped", more);
}

void Session::tell_output(std::string_view category, const std::string& text, std::optional<std::uint64_t> line) {
  Json body = {{"category", category}, {"output", text + "\n"}};
  if (line && is_launched()) {
    body["source"] = source();
    body["line"] = client.to_client_line(*line);
  }
  emit_("output", body);
}

std::string Session::describe(const running::Event& event) const {
  if (const auto* const change = std::get_if<running::ToolEvent>(&event.what)) {
    std::string name = running::tool_name(change->tool);
    const configuration::Tool* const tool = configuration_.machine.find_tool(change->tool);
    if (tool && !tool->name.empty()) name += fmt::format(" ({})", tool->name);
    return in_language(kToolChange, name);
  }
  if (const auto* const speed = std::get_if<running::SpindleSpeedEvent>(&event.what))
    return in_language(kSpindleSpeed, show_value(speed->speed));
  if (const auto* const call = std::get_if<running::FunctionEvent>(&event.what)) {
    std::string text = fmt::format("M{:02}", call->number);
    for (const execution::FunctionParameter& each : call->parameters)
      text += fmt::format(" P{}={}", each.number, show_value(each.value));
    const configuration::NamedFunction* const named = configuration_.machine.find_function(call->number);
    if (named && !named->name.empty()) text += fmt::format(" ({})", named->name);
    return text;
  }
  if (std::holds_alternative<running::UpdateEvent>(event.what)) return std::string(in_language(kUpdate));
  return {};
}

/// What the machine does, as long as somebody can read it.
void Session::tell_events(std::span<const running::Event> events) {
  for (const running::Event& event : events) {
    if (std::holds_alternative<running::MoveEvent>(event.what)) continue;
    const std::string text = describe(event);
    if (text.empty()) continue;
    const auto now = Clock::now();
    if (now - output_second_ > kOutputSecond) {
      tell_untold();
      output_second_ = now;
      outputs_ = 0;
    }
    if (++outputs_ > kMostOutputs) {
      ++untold_;
    } else {
      tell_output("stdout", text, event.line);
    }
  }
}

/// None is left out: the run waits rather than tell more than a client can take.
void Session::tell_messages(const Breakpoints::Outcome& outcome, std::uint64_t line) {
  for (const std::string& message : outcome.messages) tell_output("console", message, line);
  messages_ += outcome.messages.size();
}

void Session::tell_untold() {
  if (untold_ > 0) tell_output("console", in_language(kUntold, std::exchange(untold_, 0)));
}

static Json pose_json(const geometry::Pose& pose) {
  return {{"x", pose.tip.x()}, {"y", pose.tip.y()}, {"z", pose.tip.z()}, {"b", pose.b}, {"c", pose.c}};
}

/// While the program runs.
void Session::tell_where_it_is() {
  tell_position(false);
  if (has_told_of_file_ || Clock::now() - last_look_at_file_ < kBetweenLooks) return;
  last_look_at_file_ = Clock::now();
  tell_of_changed_file();
}

void Session::tell_position(bool at_once) {
  const auto now = Clock::now();
  if (!at_once && now - last_position_ < kBetweenPositions) return;
  last_position_ = now;
  const simulation::Simulation& present = debuggee_->present();
  const motion::Sample sample = present.sample();
  const execution::State& state = present.run().state;
  Json body = {{"line", client.to_client_line(present.line())},
               {"time", present.time()},
               {"running", is_running()},
               {"tip", pose_json(sample.tip)},
               {"joints", pose_json(motion::pose(sample.joints))},
               {"programmed", pose_json(programmed_pose(moment()))},
               {"speed", sample.speed * motion::kSecondsPerMinute},
               {"spindle", {{"function", state.spindle}, {"speed", state.spindle_speed}}},
               {"tool", nullptr}};
  if (state.tool != execution::ToolCode{}) {
    const auto radius = debuggee_->machine().tool_radii.find(state.tool);
    body["tool"] = {{"name", running::tool_name(state.tool)},
                    {"length", debuggee_->machine().tool_length(state.tool)},
                    {"radius", radius == debuggee_->machine().tool_radii.end() ? 0.0 : radius->second}};
  }
  emit_("isocnc/position", body);
}

void Session::tell_progress(double part) {
  const auto now = Clock::now();
  if (!client.takes_progress || now - activity_begin_ < kPatience || now - last_progress_ < kBetweenProgress) return;
  last_progress_ = now;
  const int percentage = std::clamp(static_cast<int>(100 * part), 0, 99);
  if (!progress_) {
    progress_ = ++progresses_;
    const bool seeks_line = activity_ == Activity::GoingOn;
    emit_("progressStart", {{"progressId", std::to_string(*progress_)},
                            {"title", seeks_line ? in_language(kGoingTo, client.to_client_line(target_line_))
                                                 : std::string(in_language(kSearching))},
                            {"cancellable", true},
                            {"percentage", percentage}});
    return;
  }
  emit_("progressUpdate", {{"progressId", std::to_string(*progress_)}, {"percentage", percentage}});
}

void Session::end_progress() {
  if (!progress_) return;
  emit_("progressEnd", {{"progressId", std::to_string(*progress_)}});
  progress_.reset();
}

/// Said once: what is debugged is what the file was.
void Session::tell_of_changed_file() {
  if (has_told_of_file_) return;
  std::error_code error;
  const auto time = std::filesystem::last_write_time(wishes_.program, error);
  if (!error && file_time_ && time == *file_time_) return;
  has_told_of_file_ = true;
  tell_output("important", std::string(in_language(kFileChanged)));
  emit_("loadedSource", {{"reason", error ? "removed" : "changed"}, {"source", source()}});
}

/// The checker reads the program on a thread of its own; until it is done, a run waits.
void Session::check_for_warnings() {
  if (is_checked_ || is_checking_ || !watchmen.is_on(Watch::Warnings)) return;
  is_checking_ = is_checked_ = true;
  pool_.post([this, debuggee = debuggee_, program = wishes_.program, language = language()] {
    configuration::Configurations configurations({}, language);
    selection::SettingsFinder finder(configurations, {});
    const selection::ProgramSettings& settings = finder.of(program);
    const std::string_view text = debuggee->text().text();
    const check::Report report =
        selection::shown_report(check::check_text(text, debuggee->setup()), text, settings.selection);
    std::multimap<std::uint64_t, Warning> warnings;
    for (const check::LocatedFinding& found : report.findings) {
      if (found.severity() != dialect::Severity::Warning) continue;
      const std::string_view line = debuggee->text().line(found.line);
      const std::string_view marked = line.substr(std::min<std::size_t>(found.finding.span.begin, line.size()),
                                                  found.finding.span.end - found.finding.span.begin);
      warnings.emplace(found.line, Warning{found.finding.id,
                                           dialect::message(found.finding.id, language, marked, found.finding.values)});
    }
    loop_.post([this, debuggee, warnings = std::move(warnings)] {
      is_checking_ = false;
      if (debuggee == debuggee_) watchmen.warnings = warnings;
    });
  });
}

}  // namespace isocnc::debugger::session
