#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "interpreter/running/event.h"
#include "interpreter/running/program.h"
#include "interpreter/syntax/line_tree.h"
#include "interpreter/syntax/tree_store.h"

namespace isocnc::running {

/// V1 to V30; [0] is not used.
using Registers = std::array<double, dialect::kRegisterCount + 1>;

/// A line that a run is about to execute. Lines that a jump skips do not count.
struct Block {
  std::size_t line = 0;  ///< From 0.
  const syntax::LineTree& tree;
  const execution::State& state;  ///< State before the block.
  const Registers& registers;     ///< Values before the block.
  double vgpl = 0;
  std::uint64_t number = 0;     ///< Number of blocks executed before this one.
  bool is_tool_unused = false;  ///< RunResult::is_tool_unused before the block.
};

/// Options of a run.
struct RunOptions {
  execution::Setup setup;
  double vgpl = 0;        ///< The GPL variable that IF compares (I.5).
  Registers registers{};  ///< Values at the start.
  /// Line (from 0) before which the run stops; if a jump skips it, the run stops at the jump's target.
  std::optional<std::size_t> until;
  /// Whether an error ends the run, as on the control; otherwise it continues as a checker does.
  bool stop_at_errors = true;
  std::function<void(const Block&)> before_block;  ///< Optional callback to follow the state of run().
  /// Optional; run() asks it at the start and then at intervals whether to end before the next line (Ending::Stopped).
  std::function<bool()> stop;
};

/// The reason for the end of a run.
enum class Ending : std::uint8_t { ProgramEnd, Error, Until, Stopped };

struct RunResult {
  Ending ending = Ending::ProgramEnd;
  std::size_t line = 0;  ///< Line of the end, from 0.
  std::string_view line_text;
  syntax::Finding error;   ///< Set if `ending` is Error.
  execution::State state;  ///< State at the end.
  Registers registers{};
  std::uint64_t blocks = 0;                     ///< Number of blocks executed.
  bool is_tool_unused = false;                  ///< A tool is mounted, and no feed move or user M has followed.
  std::optional<std::size_t> jumped_over_from;  ///< For Until: line (from 0) of the IF that skips the requested line.
};

/// A run that advances line by line and can be stopped between any two. A value: a copy runs independently, exactly as
/// the original. The program and options must outlive it.
class Runner {
 public:
  Runner(const Program& program, const RunOptions& options);

  bool has_ended() const { return has_ended_; }

  /// The next line, before it is executed; none after the last line or at RunOptions::until. Valid until the next
  /// non-const call.
  std::optional<Block> next();

  /// Executes the next line and takes its jump, or ends the run. A block with an error has no effect.
  void step();

  /// Executes empty lines (D13) up to the next block or the end.
  void pass_empty_lines();

  /// Events of the last step(), still available after pass_empty_lines(); valid until the next step(). Empty in a copy.
  std::span<const Event> events() const { return workbench_.events; }

  /// Start of the next line.
  const LinePlace& place() const { return place_; }
  /// The result so far; `ending` and `line` are valid after the end of the run.
  const RunResult& result() const { return result_; }
  double vgpl() const { return vgpl_; }

  /// Sets the value that the following IFs see (I.5). `reg` from 1 to 30.
  void set_register(int reg, double value) { result_.registers[static_cast<std::size_t>(reg)] = value; }
  void set_vgpl(double value) { vgpl_ = value; }
  /// Replaces the state, as if the executed blocks had led to this one.
  void set_state(const execution::State& state) { result_.state = state; }
  /// Sets whether the tool in the machine has not been used yet.
  void set_tool_unused(bool is_unused) { result_.is_tool_unused = is_unused; }
  /// Ends the run before the next line.
  void stop() { end(Ending::Stopped, place_.line); }

 private:
  /// Scratch memory. It is not part of the run's value, so a copy starts empty.
  struct ScratchMemory {
    ScratchMemory() = default;
    ScratchMemory(const ScratchMemory&) : ScratchMemory() {}
    ScratchMemory& operator=(const ScratchMemory& other) {
      if (this == &other) return *this;
      holds_line = false;
      events.clear();
      return *this;
    }
    ~ScratchMemory() = default;

    syntax::TreeStore store;
    syntax::LineTree tree;
    const char* line_end = nullptr;
    bool holds_line = false;    ///< The tree is that of the next line.
    std::vector<Event> events;  ///< Events of one block.
  };

  bool is_at_end_of_text() const { return place_.offset == program_->text().size(); }
  bool is_at_until() const { return options_->until && place_.line >= *options_->until; }
  const syntax::LineTree& read_line();
  bool empty_line_comes();
  void step_line();
  /// A jump of a line, and whether it is taken.
  struct DecidedJump {
    syntax::Jump jump;
    bool is_taken = false;
  };

  void execute_line(const syntax::LineTree& tree);
  std::vector<DecidedJump> execute_blocks(const syntax::LineTree& tree, execution::Sink& sink);
  bool execute_around_jump(const syntax::LineTree& tree, execution::Sink& sink);
  void branch(const syntax::Jump& jump, bool is_taken, const LinePlace& from);
  bool is_taken(const syntax::Jump& jump) const;
  void end(Ending ending, std::size_t line);
  void fail(const syntax::Finding& error);

  const Program* program_;
  const RunOptions* options_;
  LinePlace place_;
  bool has_ended_ = false;
  double vgpl_;
  RunResult result_;
  ScratchMemory workbench_;
};

/// Whether the condition of an IF holds for a value of its register or VGPL; false if it cannot be read.
bool holds(const syntax::Jump& jump, double value);

/// Runs a program as the control does, block by block, and passes its events to `on_event`. A block with an error has
/// no effect: the control stops there. A UTF-8 byte-order mark is not part of `text`. Only `options.stop` ends a run
/// with Ending::Stopped, at the line that comes next.
RunResult run(std::string_view text, const RunOptions& options, const std::function<void(const Event&)>& on_event);

}  // namespace isocnc::running
