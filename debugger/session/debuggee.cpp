#include "debugger/session/debuggee.h"

#include <algorithm>
#include <utility>

#include "interpreter/execution/feed.h"

namespace isocnc::debugger::session {

using running::Program;
using running::Runner;
using running::RunOptions;
using simulation::History;
using simulation::Simulation;
using simulation::TimedMachine;

Debuggee::Debuggee(ProgramText text, const RunOptions& options, const TimedMachine& machine)
    : text_(std::make_unique<const ProgramText>(std::move(text))),
      program_(std::make_unique<const Program>(text_->text())),
      options_(std::make_unique<const RunOptions>(options)) {
  auto own_machine = std::make_unique<const TimedMachine>(machine);
  const Simulation begin(*program_, *options_, *own_machine);
  stretches_.push_back({.machine = std::move(own_machine), .history = History(begin)});
}

bool Debuggee::is_at_start_of_part() const {
  return present().blocks() == stretches_.back().first_block && !present().is_in_block() && !present().has_ended();
}

bool Debuggee::is_at_start() const { return stretches_.size() == 1 && is_at_start_of_part(); }

/// Of a history, or of a simulation by itself.
template <class Run>
static void step_instruction_of(Run& run, const Simulation& present) {
  const auto segment = present.segment();
  if (segment && segment->number + 1 < segment->count) {
    run.advance_along(segment->left);
  } else {
    run.step_instruction();
  }
}

void Debuggee::step_instruction() { step_instruction_of(history(), present()); }

void Debuggee::step_back() {
  if (is_at_start_of_part()) {
    if (stretches_.size() > 1) stretches_.pop_back();
    return;
  }
  history().step_back();
}

void Debuggee::step_instruction_back() {
  const double time = present().time();
  const bool was_in_block = present().is_in_block();
  const bool is_undoing = is_at_start_of_part();
  step_back();
  if (is_undoing) return;
  // As often as it comes to less than the way so far: a copy goes ahead to see.
  const std::uint64_t blocks = present().blocks() + 1;
  for (Simulation ahead = present();;) {
    step_instruction_of(ahead, ahead);
    const bool is_there = was_in_block ? ahead.time() >= time : !ahead.is_in_block();
    if (is_there || ahead.has_ended() || ahead.blocks() > blocks) return;
    step_instruction();
  }
}

void Debuggee::go_to_block(std::uint64_t blocks) {
  while (stretches_.size() > 1 && blocks < stretches_.back().first_block) stretches_.pop_back();
  history().go_to_block(blocks);
}

/// In the stretch that the line lies in: what an earlier one has done behind its change is undone.
std::optional<std::uint64_t> Debuggee::find_line(std::uint64_t line) const {
  for (auto stretch = stretches_.rbegin(); stretch != stretches_.rend(); ++stretch)
    if (line >= stretch->first_line) return stretch->history.find_line(line);
  return std::nullopt;
}

std::optional<std::uint64_t> Debuggee::find_back(std::uint64_t from, std::uint64_t blocks,
                                                 const std::function<bool(const running::Block&)>& is_it) const {
  for (auto stretch = stretches_.rbegin(); stretch != stretches_.rend() && from < blocks; ++stretch) {
    const std::uint64_t begin = std::max(from, stretch->first_block);
    if (begin >= blocks) continue;
    if (const auto found = stretch->history.find_before(blocks, is_it, begin)) return found;
    blocks = begin;
  }
  return std::nullopt;
}

std::optional<Hindrance> Debuggee::hindrance() const {
  if (present().has_ended()) return Hindrance::HasEnded;
  if (present().is_in_block()) return Hindrance::InBlock;
  if (present().run().state.mode(dialect::ModalGroup::CutterCompensation) != 40) return Hindrance::Compensation;
  return std::nullopt;
}

void Debuggee::begin_stretch(const Simulation& from, const Runner& runner, const TimedMachine& machine) {
  auto own_machine = std::make_unique<const TimedMachine>(machine);
  const Simulation begin(from, runner, *own_machine);
  stretches_.push_back({.machine = std::move(own_machine),
                        .history = History(begin),
                        .first_block = begin.blocks(),
                        .first_line = begin.line()});
}

void Debuggee::set_state(const execution::State& state) {
  Runner runner = present().runner();
  runner.set_state(state);
  begin_stretch(present(), runner, machine());
}

void Debuggee::set_feed(double number) {
  execution::State state = present().run().state;
  execution::take_feed(number, state);
  set_state(state);
}

void Debuggee::set_spindle_speed(double number) {
  execution::State state = present().run().state;
  execution::take_spindle_speed(number, state);
  set_state(state);
}

void Debuggee::set_feed_override(double factor) {
  TimedMachine changed = machine();
  changed.feed_override = factor;
  begin_stretch(present(), present().runner(), changed);
}

MdiOutcome Debuggee::run_by_hand(std::string_view text) {
  // A last line to stop before: at the end of the text an M02 would be missing.
  MdiOutcome outcome{.events = {}, .error = {}, .text = std::make_shared<const std::string>(std::string(text) + "\n;")};
  const Program program(*outcome.text);
  RunOptions options = *options_;
  options.until = ProgramText(*outcome.text).line_count() - 1;
  Runner by_hand(program, options);
  by_hand.set_state(present().run().state);
  for (int number = 1; number <= dialect::kRegisterCount; ++number)
    by_hand.set_register(number, present().run().registers[static_cast<std::size_t>(number)]);
  by_hand.set_vgpl(present().vgpl());
  Simulation simulation(present(), by_hand, machine());
  while (!simulation.has_ended()) {
    simulation.step_block();
    const auto events = simulation.runner().events();
    outcome.events.insert(outcome.events.end(), events.begin(), events.end());
  }
  const running::RunResult& result = simulation.run();
  if (result.ending == running::Ending::Error) {
    outcome.error = result;
    outcome.events.clear();
    return outcome;
  }
  execution::State state = result.state;
  state.ended = false;  // An M02 ends what is done by hand, and not the program.
  Runner runner = present().runner();
  runner.set_state(state);
  for (int number = 1; number <= dialect::kRegisterCount; ++number)
    runner.set_register(number, result.registers[static_cast<std::size_t>(number)]);
  begin_stretch(simulation, runner, machine());
  return outcome;
}

}  // namespace isocnc::debugger::session
