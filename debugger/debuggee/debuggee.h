#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "debugger/debuggee/program_text.h"
#include "interpreter/simulation/history.h"

namespace isocnc::debuggee {

/// Why the machine cannot be changed by hand where it stands.
enum class Hindrance : std::uint8_t {
  InBlock,       ///< The machine is within a block.
  Compensation,  ///< G41 or G42 is in force: the tool is beside the contour.
  HasEnded,      ///< The program has ended.
};

/// The result of blocks run by hand.
struct MdiOutcome {
  std::vector<running::Event> events;
  std::optional<running::RunResult> error;  ///< The error that has stopped them; then nothing has been done.
  std::shared_ptr<const std::string> text;  ///< The blocks, which hold the line of the error.
};

/// A program on the simulated machine, which runs forward and backward, and can be changed by hand. A register or VGPL
/// that is set somewhere is set there again when the run comes by again. A change of the machine itself (MDI blocks, S
/// and F, the override of the feed) brings it to rest, and begins a new part of the history: stepping back over the
/// change undoes it.
class Debuggee {
 public:
  Debuggee(ProgramText text, const running::RunOptions& options, const timing::TimedMachine& machine);

  const ProgramText& text() const { return *text_; }
  const timing::TimedMachine& machine() const { return *parts_.back().machine; }
  const execution::Setup& setup() const { return options_->setup; }
  const simulation::Simulation& present() const { return history().present(); }
  /// Nothing has been executed yet.
  bool is_at_start() const;

  // As in History.
  std::optional<running::Block> next() { return history().next(); }
  void step_block() { history().step_block(); }
  void advance_in_block(double seconds) { history().advance_in_block(seconds); }
  /// To a moment in the block in progress or, between two blocks, in the next one, which may be its start.
  void advance_to_moment(double seconds);
  /// When a step in from here ends: seconds since the start.
  double end_of_instruction() const;
  /// To the end of the instruction, or of the segment of an arc in G49, that the machine is at; between two blocks to
  /// the start of the next one.
  void step_instruction();
  void step_back();
  /// Undoes step_instruction().
  void step_instruction_back();
  void go_to_block(std::uint64_t blocks);
  void skip_to_line(std::size_t line) { history().skip_to_line(line); }
  void return_to(const simulation::Simulation& before) { history().return_to(before); }
  /// As in History.
  std::optional<std::uint64_t> find_line(std::size_t line) const;
  /// The last of the blocks [from, blocks) for which `is_it` holds.
  std::optional<std::uint64_t> find_back(std::uint64_t from, std::uint64_t blocks,
                                         const std::function<bool(const running::Block&)>& is_it) const;

  /// As History::find_simulated_before.
  std::optional<std::uint64_t> find_simulated_back(
      std::uint64_t from, std::uint64_t blocks, const std::function<bool(simulation::Simulation&)>& pass_block) const;

  /// Takes simulations through the blocks [from, blocks), in their order: `pass_block` gets the simulation before each
  /// of them and takes it to the end of the block. `pass_by_hand` gets each simulation of what has been run by hand
  /// where more than `from` blocks had been executed and at most `blocks`, and takes it to its end. Without `from`,
  /// what has been run by hand before the first block counts, too. The blocks may be still to come.
  void pass_blocks(std::optional<std::uint64_t> from, std::uint64_t blocks,
                   const std::function<void(simulation::Simulation&)>& pass_block,
                   const std::function<void(simulation::Simulation&)>& pass_by_hand) const;

  /// Whether blocks have been run by hand where this many of the program had been executed.
  bool is_run_by_hand_at(std::uint64_t blocks) const;

  void set_register(int number, double value) { history().set_register(number, value); }
  void set_vgpl(double value) { history().set_vgpl(value); }

  /// Changes of the machine by hand up to the present, without those that have been undone.
  std::size_t change_count() const { return parts_.size() - 1; }

  std::optional<Hindrance> hindrance() const;
  // Only where nothing hinders it.
  void set_feed(double number);           ///< Does all that an F of the program does.
  void set_spindle_speed(double number);  ///< Does all that an S of the program does.
  /// 1: feeds as written.
  void set_feed_override(double factor);
  double feed_override() const { return machine().feed_override; }
  MdiOutcome run_by_hand(std::string_view text);

 private:
  /// Blocks that have been run by hand.
  struct HandRun {
    HandRun(std::shared_ptr<const std::string> blocks, const running::RunOptions& run);

    std::shared_ptr<const std::string> text;
    running::Program program;
    running::RunOptions options;
    std::optional<simulation::Simulation> begin;
  };

  void set_state(const execution::State& state);
  /// The history from a change of the machine by hand, or from the start, to the next change.
  struct Part {
    std::unique_ptr<const timing::TimedMachine> machine;
    simulation::History history;
    std::uint64_t first_block = 0;
    std::size_t first_line = 0;
    std::shared_ptr<const HandRun> by_hand = {};  ///< What has led to its start; or null.
  };

  simulation::History& history() { return parts_.back().history; }
  const simulation::History& history() const { return parts_.back().history; }
  bool is_at_start_of_part() const;
  simulation::Simulation simulation_of(const running::Program& program, const running::RunOptions& options) const;
  void take_over(const simulation::Simulation& by_hand);
  template <class Find>
  std::optional<std::uint64_t> find_in_parts(std::uint64_t from, std::uint64_t blocks, const Find& find) const;
  void begin_part(const simulation::Simulation& from, const running::Runner& runner,
                  const timing::TimedMachine& machine);

  // On the heap, so that references to them stay valid when the debuggee is moved.
  std::unique_ptr<const ProgramText> text_;
  std::unique_ptr<const running::Program> program_;
  std::unique_ptr<const running::RunOptions> options_;
  std::deque<Part> parts_;
};

}  // namespace isocnc::debuggee
