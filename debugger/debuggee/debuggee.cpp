#include "debugger/debuggee/debuggee.h"

#include <algorithm>
#include <utility>

#include "interpreter/execution/feed.h"

namespace isocnc::debuggee {

using running::Program;
using running::Runner;
using running::RunOptions;
using simulation::History;
using simulation::Simulation;
using timing::TimedMachine;

Debuggee::Debuggee(ProgramText text, const RunOptions& options, const TimedMachine& machine)
    : text_(std::make_unique<const ProgramText>(std::move(text))),
      program_(std::make_unique<const Program>(text_->text())),
      options_(std::make_unique<const RunOptions>(options)) {
  auto own_machine = std::make_unique<const TimedMachine>(machine);
  const Simulation begin(*program_, *options_, *own_machine);
  parts_.push_back({.machine = std::move(own_machine), .history = History(begin)});
}

bool Debuggee::is_at_start_of_part() const {
  return present().blocks() == parts_.back().first_block && !present().is_in_block() && !present().has_ended();
}

bool Debuggee::is_at_start() const { return parts_.size() == 1 && is_at_start_of_part(); }

/// Steps a history, or a simulation by itself.
template <class Run>
static void step_instruction_of(Run& run, const Simulation& present) {
  const auto segment = present.segment();
  if (segment && segment->number + 1 < segment->count) {
    run.advance_along(segment->left);
  } else {
    run.step_instruction();
  }
}

void Debuggee::advance_to_moment(double seconds) {
  if (!present().is_in_block() && !(seconds > present().time())) return history().step_instruction();
  history().advance_in_block(seconds);
}

double Debuggee::end_of_instruction() const {
  Simulation ahead = present();
  step_instruction_of(ahead, present());
  return ahead.time();
}

void Debuggee::step_instruction() { step_instruction_of(history(), present()); }

void Debuggee::step_back() {
  if (is_at_start_of_part()) {
    if (parts_.size() > 1) parts_.pop_back();
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
  // Steps as long as they lead to before where it was: a copy takes each step first.
  const std::uint64_t blocks = present().blocks() + 1;
  for (Simulation ahead = present();;) {
    step_instruction_of(ahead, ahead);
    const bool is_there = was_in_block ? ahead.time() >= time : !ahead.is_in_block();
    if (is_there || ahead.has_ended() || ahead.blocks() > blocks) return;
    step_instruction();
  }
}

void Debuggee::go_to_block(std::uint64_t blocks) {
  while (parts_.size() > 1 && blocks < parts_.back().first_block) parts_.pop_back();
  history().go_to_block(blocks);
}

/// Searches the last part that begins at or before the line: what was executed after its end has been undone.
std::optional<std::uint64_t> Debuggee::find_line(std::size_t line) const {
  for (auto part = parts_.rbegin(); part != parts_.rend(); ++part)
    if (line >= part->first_line) return part->history.find_line(line);
  return std::nullopt;
}

/// Searches the parts from the last one back. `find` searches the blocks [from, blocks) of a history.
template <class Find>
std::optional<std::uint64_t> Debuggee::find_in_parts(std::uint64_t from, std::uint64_t blocks, const Find& find) const {
  for (auto part = parts_.rbegin(); part != parts_.rend() && from < blocks; ++part) {
    const std::uint64_t begin = std::max(from, part->first_block);
    if (begin >= blocks) continue;
    if (const auto found = find(part->history, begin, blocks)) return found;
    blocks = begin;
  }
  return std::nullopt;
}

std::optional<std::uint64_t> Debuggee::find_back(std::uint64_t from, std::uint64_t blocks,
                                                 const std::function<bool(const running::Block&)>& is_it) const {
  return find_in_parts(from, blocks, [&](const History& history, std::uint64_t begin, std::uint64_t end) {
    return history.find_before(end, is_it, begin);
  });
}

std::optional<std::uint64_t> Debuggee::find_simulated_back(std::uint64_t from, std::uint64_t blocks,
                                                           const std::function<bool(Simulation&)>& pass_block) const {
  return find_in_parts(from, blocks, [&](const History& history, std::uint64_t begin, std::uint64_t end) {
    return history.find_simulated_before(end, pass_block, begin);
  });
}

void Debuggee::pass_blocks(std::optional<std::uint64_t> from, std::uint64_t blocks,
                           const std::function<void(Simulation&)>& pass_block,
                           const std::function<void(Simulation&)>& pass_by_hand) const {
  for (std::size_t i = 0; i < parts_.size() && parts_[i].first_block <= blocks; ++i) {
    const Part& part = parts_[i];
    if (part.by_hand && (!from || part.first_block > *from)) {
      Simulation simulation = *part.by_hand->begin;
      pass_by_hand(simulation);
    }
    const std::uint64_t begin = std::max(from.value_or(0), part.first_block);
    const std::uint64_t end = i + 1 < parts_.size() ? std::min(blocks, parts_[i + 1].first_block) : blocks;
    const auto pass = [&](Simulation& simulation) {
      pass_block(simulation);
      return false;
    };
    if (begin < end) part.history.find_simulated_before(end, pass, begin);
  }
}

bool Debuggee::is_run_by_hand_at(std::uint64_t blocks) const {
  return std::any_of(parts_.begin(), parts_.end(),
                     [&](const Part& part) { return part.by_hand && part.first_block == blocks; });
}

std::optional<Hindrance> Debuggee::hindrance() const {
  if (present().has_ended()) return Hindrance::HasEnded;
  if (present().is_in_block()) return Hindrance::InBlock;
  if (present().run().state.is_compensated()) return Hindrance::Compensation;
  return std::nullopt;
}

void Debuggee::begin_part(const Simulation& from, const Runner& runner, const TimedMachine& machine) {
  auto own_machine = std::make_unique<const TimedMachine>(machine);
  const Simulation begin(from, runner, *own_machine);
  parts_.push_back({.machine = std::move(own_machine),
                    .history = History(begin),
                    .first_block = begin.blocks(),
                    .first_line = begin.line()});
}

void Debuggee::set_state(const execution::State& state) {
  Runner runner = present().runner();
  runner.set_state(state);
  begin_part(present(), runner, machine());
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
  begin_part(present(), present().runner(), changed);
}

static void set_registers(Runner& runner, const running::Registers& registers) {
  for (int number = 1; number <= dialect::kRegisterCount; ++number)
    runner.set_register(number, registers[static_cast<std::size_t>(number)]);
}

/// The machine as it stands, about to run another program.
Simulation Debuggee::simulation_of(const Program& program, const RunOptions& options) const {
  Runner runner(program, options);
  runner.set_state(present().run().state);
  runner.set_tool_unused(present().run().is_tool_unused);
  runner.set_vgpl(present().vgpl());
  set_registers(runner, present().run().registers);
  return {present(), runner, machine()};
}

/// The program goes on from where the other one has led.
void Debuggee::take_over(const Simulation& by_hand) {
  execution::State state = by_hand.run().state;
  state.ended = false;  // An M02 ends what is done by hand, and not the program.
  state.exact_stop_fits = present().run().state.exact_stop_fits;  // A G09 follows a line of the program (D23).
  Runner runner = present().runner();
  runner.set_state(state);
  runner.set_tool_unused(by_hand.run().is_tool_unused);
  set_registers(runner, by_hand.run().registers);
  begin_part(by_hand, runner, machine());
}

Debuggee::HandRun::HandRun(std::shared_ptr<const std::string> blocks, const RunOptions& run)
    : text(std::move(blocks)), program(*text), options(run) {
  options.until = ProgramText(*text).line_count() - 1;
}

MdiOutcome Debuggee::run_by_hand(std::string_view text) {
  // The last line is one to stop before: without it the text would lack an M02.
  MdiOutcome outcome{.events = {}, .error = {}, .text = std::make_shared<const std::string>(std::string(text) + "\n;")};
  const auto run = std::make_shared<HandRun>(outcome.text, *options_);
  run->begin = simulation_of(run->program, run->options);
  Simulation simulation = *run->begin;
  while (!simulation.has_ended()) {
    simulation.step_block();
    const auto events = simulation.runner().events();
    outcome.events.insert(outcome.events.end(), events.begin(), events.end());
  }
  if (simulation.run().ending == running::Ending::Error) {
    outcome.error = simulation.run();
    outcome.events.clear();
  } else {
    take_over(simulation);
    parts_.back().by_hand = run;
  }
  return outcome;
}

}  // namespace isocnc::debuggee
