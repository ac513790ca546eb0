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

/// A line that a run is about to execute. Lines that a jump passes over are none.
struct Block {
  std::uint64_t line = 0;  ///< From 0.
  const syntax::LineTree& tree;
  const execution::State& state;  ///< Before it.
  const Registers& registers;     ///< Before it.
  double vgpl = 0;
  std::uint64_t number = 0;  ///< Blocks that have been executed before it.
};

/// What a run is given besides the program.
struct RunOptions {
  execution::Setup setup;
  double vgpl = 0;                                 ///< The GPL variable that IF compares (I.5).
  Registers registers{};                           ///< At the start.
  std::optional<std::uint64_t> until;              ///< Stop before this line (from 0), or where a jump over it leads.
  bool stop_at_errors = true;                      ///< As the control does; else go on as a checker reads it.
  std::function<void(const Block&)> before_block;  ///< Where somebody wants to follow the state of a run().
};

/// Why a run came to its end.
enum class Ending : std::uint8_t { ProgramEnd, Error, Until };

struct RunResult {
  Ending ending = Ending::ProgramEnd;
  std::uint64_t line = 0;  ///< Of the end, from 0.
  std::string_view line_text;
  syntax::Finding error;   ///< When `ending` is Error.
  execution::State state;  ///< At the end.
  Registers registers{};
  std::uint64_t blocks = 0;                       ///< Blocks executed.
  std::optional<std::uint64_t> jumped_over_from;  ///< Until: the IF (from 0) that leads over the line asked for.
};

/// A run that goes on line by line, and stops wherever one likes. A value: a copy goes on by itself, exactly as the
/// original. It refers to its program and options, which outlive it.
class Runner {
 public:
  Runner(const Program& program, const RunOptions& options);

  bool has_ended() const { return has_ended_; }

  /// The line that comes next, before it is executed; none behind the last one, or where the run is to stop. Valid
  /// until the runner is used again.
  std::optional<Block> next();

  /// Executes the line that comes next, and takes its jump, or ends the run. A block with an error does nothing.
  void step();

  /// Executes lines that hold nothing (D13), so that a block comes next, or the end.
  void pass_empty_lines();

  /// What the last step() did, also behind empty lines that have been passed; valid until the next one. A copy has
  /// none.
  std::span<const Event> events() const { return workbench_.events; }

  /// Begin of the line that comes next.
  const Place& place() const { return place_; }
  /// How far the run has come; `ending` and `line` count once it has ended.
  const RunResult& result() const { return result_; }
  double vgpl() const { return vgpl_; }

  /// What the IFs that follow see (I.5). `reg` from 1 to 30.
  void set_register(int reg, double value) { result_.registers[static_cast<std::size_t>(reg)] = value; }
  void set_vgpl(double value) { vgpl_ = value; }
  /// As if what has been executed had led to this state.
  void set_state(const execution::State& state) { result_.state = state; }

 private:
  /// Memory to work in. It says nothing about the run, so a copy begins with none.
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
    bool holds_line = false;    ///< The tree is that of the line that comes next.
    std::vector<Event> events;  ///< Of one block.
  };

  bool is_at_end_of_text() const { return place_.offset == program_->text().size(); }
  bool is_at_until() const { return options_->until && place_.line >= *options_->until; }
  const syntax::LineTree& read_line();
  bool empty_line_comes();
  void step_line();
  void execute_line(const syntax::LineTree& tree);
  void branch(const syntax::Jump& jump, const Place& from);
  bool holds(const syntax::Jump& jump) const;
  void end(Ending ending, std::uint64_t line);
  void fail(const syntax::Finding& error);

  const Program* program_;
  const RunOptions* options_;
  Place place_;
  bool has_ended_ = false;
  double vgpl_;
  RunResult result_;
  ScratchMemory workbench_;
};

/// Runs a program as the control would, one block after another; what it does goes to `on_event`. A block with an error
/// does nothing: the control stops there. A UTF-8 byte-order mark is not part of `text`.
RunResult run(std::string_view text, const RunOptions& options, const std::function<void(const Event&)>& on_event);

}  // namespace isocnc::running
