#include "debugger/session/session.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "debugger/session/event_text.h"
#include "debugger/session/launch.h"
#include "interpreter/configuration/scenes.h"
#include "interpreter/running/error_message.h"
#include "interpreter/system/user_language.h"
#include "interpreter/verification/verifier.h"

namespace isocnc::session {

using dialect::Language;
using dialect::Text;

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
static constexpr Text kDone{"done", "eseguito"};

Session::Session(rpc::Loop& loop, Notifier::Emit emit, std::optional<Language> language)
    : notifier_(std::move(emit), state_), run_loop_(loop, state_, notifier_) {
  state_.commanded_language = language;
}

// --- Lifecycle

void Session::launch(LaunchOptions options) {
  if (is_launched()) throw dap::RequestError(std::string(in_language(kLaunchedAlready)));
  begin(std::move(options));
  if (launch_options().break_on_warnings) exception_filters().turn_on(breakpoints::ExceptionFilter::Warnings);
}

void Session::begin(LaunchOptions options) {
  const debuggee::FileWatch file_watch(options.program);  // A change while the file is read counts.
  const Language clients = client().locale.value_or(system::user_language());
  Launch launched = session::launch(options, state_.commanded_language, clients);
  state_.launch_options = std::move(options);
  state_.configuration = std::move(launched.configuration);
  state_.debuggee = std::make_shared<debuggee::Debuggee>(std::move(launched.debuggee));
  state_.surroundings = std::make_shared<debuggee::Surroundings>(
      *state_.debuggee, [this] { return load_scene(); },
      [this] {
        const running::RunOptions run = run_options(launch_options(), state_.configuration);
        return verification::first_workpiece_origin(debuggee().text().text(), run);
      });
  state_.journal = {};
  state_.exception.reset();
  state_.exception_filters.warnings.clear();
  state_.exception_filters.of_run.clear();
  state_.breakpoints.forget_hits_from(0);
  run_loop_.reset(file_watch);
  report_moved_breakpoints();
}

/// What is wrong with its description is reported: then there is none.
std::shared_ptr<const verification::Scene> Session::load_scene() {
  configuration::Scenes scenes(language());
  auto scene = scenes.of(state_.configuration, launch_options().program);
  for (const std::string& mistake : scenes.mistakes(language())) notifier_.report_output("important", mistake);
  return scene;
}

void Session::configuration_done() {
  require_launch();
  is_configured_ = true;
  run_loop_.start_program();
}

void Session::restart(std::optional<LaunchOptions> options) {
  require_launch();
  begin(options ? std::move(*options) : launch_options());
  notifier_.end_progress();
  if (is_configured_) configuration_done();
}

void Session::terminate() {
  require_launch();
  run_loop_.end_later(0);
}

// --- Asking

void Session::require_launch() const {
  if (!is_launched()) throw dap::RequestError(std::string(in_language(kNotLaunched)));
}

const debuggee::Debuggee& Session::debuggee() const {
  require_launch();
  return *state_.debuggee;
}

debuggee::Debuggee& Session::stopped_debuggee() const {
  require_launch();
  if (is_running()) throw dap::RequestError(std::string(in_language(kIsRunning)));
  return *state_.debuggee;
}

expressions::Moment Session::moment() const {
  require_launch();
  return state_.moment();
}

// --- Running

void Session::resume() {
  stopped_debuggee();
  run_loop_.resume();
}

void Session::reverse() {
  stopped_debuggee();
  run_loop_.reverse();
}

void Session::pause() {
  require_launch();
  run_loop_.pause();
}

void Session::step(dap::Step step) {
  stopped_debuggee();
  run_loop_.step(step);
}

void Session::step_back(dap::Step step) {
  stopped_debuggee();
  run_loop_.step_back(step);
}

void Session::step_out() {
  stopped_debuggee();
  run_loop_.step_out();
}

void Session::go_to_line(std::size_t line) {
  stopped_debuggee();
  run_loop_.go_to_line(line);
}

void Session::run_to_difference(const std::filesystem::path& file) {
  stopped_debuggee();
  run_loop_.run_to_difference(read_reference(file, state_));
}

void Session::run_to_difference(std::string name, std::string text) {
  stopped_debuggee();
  run_loop_.run_to_difference(reference_text(std::move(name), std::move(text), state_));
}

// --- Changing

/// What has been executed after this place in an earlier run is void.
void Session::finish_change() {
  run_loop_.forget_future();
  notifier_.report_invalidated();
  notifier_.report_standing_position();
}

void Session::require_change_by_hand() const {
  const auto hindrance = stopped_debuggee().hindrance();
  if (!hindrance) return;
  const Text& why = *hindrance == debuggee::Hindrance::InBlock        ? kInBlock
                    : *hindrance == debuggee::Hindrance::Compensation ? kCompensation
                                                                      : kHasEnded;
  throw dap::RequestError(std::string(in_language(why)));
}

void Session::change_variables(const std::function<void(debuggee::Debuggee& debuggee)>& change) {
  change(stopped_debuggee());
  finish_change();
}

void Session::change_machine(const std::function<void(debuggee::Debuggee& debuggee)>& change) {
  require_change_by_hand();
  change_variables(change);
}

void Session::set_playback(double speed) {
  stopped_debuggee();
  state_.launch_options.speed = speed;
  run_loop_.restart_pace();
}

void Session::refuse_to_set(std::string_view name) const { throw dap::RequestError(in_language(kNotSettable, name)); }

void Session::set_quantity(const expressions::Quantity& quantity, double value) {
  stopped_debuggee();
  if (quantity.set == nullptr) refuse_to_set(quantity.name);
  if (!std::isfinite(value) || !quantity.set(*this, quantity.index, value))
    throw dap::RequestError(in_language(kBadValue, quantity.name, expressions::show_value(value)));
}

/// What the blocks did, a line each, and where they have led the tip.
static std::string mdi_text(const debuggee::MdiOutcome& outcome, const SessionState& state) {
  std::string text;
  for (const running::Event& event : outcome.events)
    if (const std::string line = event_text(event, state); !line.empty()) text += line + "\n";
  const geometry::Pose tip = expressions::machine_pose(state.moment());
  return text + fmt::format("{}: XM {} YM {} ZM {} BM {} CM {}", state.in_language(kDone),
                            expressions::show_value(tip.tip.x()), expressions::show_value(tip.tip.y()),
                            expressions::show_value(tip.tip.z()), expressions::show_value(tip.b),
                            expressions::show_value(tip.c));
}

std::string Session::run_by_hand(std::string_view text) {
  require_change_by_hand();
  const debuggee::MdiOutcome outcome = stopped_debuggee().run_by_hand(text);
  if (outcome.error) {
    const std::string_view code = dialect::definition(outcome.error->error.id).code;
    throw dap::RequestError(fmt::format("{}: {}", code, running::error_message(*outcome.error, language())));
  }
  run_loop_.skip_judgement();
  finish_change();
  return mdi_text(outcome, state_);
}

// --- Breakpoints

const std::vector<breakpoints::SourceBreakpoint>& Session::set_source_breakpoints(
    std::vector<breakpoints::SourceBreakpoint> breakpoints) {
  source_breakpoints_ = std::move(breakpoints);
  place_source_breakpoints();
  return source_breakpoints_;
}

/// Each on the first line from the wanted one on that does something.
void Session::place_source_breakpoints() {
  const debuggee::ProgramText& text = debuggee().text();
  std::vector<breakpoints::LineBreakpoint> placed;
  for (breakpoints::SourceBreakpoint& each : source_breakpoints_) {
    each.line.reset();
    if (!each.problem.empty()) continue;
    each.line = text.executable_line(each.wanted_line);
    if (each.line) placed.push_back({{.id = each.id, .rules = each.rules, .counter = {}}, *each.line});
  }
  state_.breakpoints.set_lines(std::move(placed), text.line_count());
}

/// The program has been read again.
void Session::report_moved_breakpoints() {
  const std::vector<breakpoints::SourceBreakpoint> before = source_breakpoints_;
  place_source_breakpoints();
  for (std::size_t i = 0; i < before.size(); ++i) {
    const breakpoints::SourceBreakpoint& now = source_breakpoints_[i];
    if (now.line == before[i].line) continue;
    Json breakpoint = {{"id", now.id}, {"verified", now.line.has_value()}, {"source", source()}};
    if (now.line) breakpoint["line"] = client().to_client_line(*now.line);
    notifier_.report_moved_breakpoint(breakpoint);
  }
}

}  // namespace isocnc::session
