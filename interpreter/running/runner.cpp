#include "interpreter/running/runner.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "interpreter/execution/execute.h"
#include "interpreter/text/characters.h"

namespace isocnc::running {

using namespace dialect::literals;

static bool is_error(const syntax::Finding& finding) {
  return dialect::definition(finding.id).severity == dialect::Severity::Error;
}

namespace {

/// Collects the effects of one block, so that a block with an error has none.
class BlockSink final : public execution::Sink {
 public:
  BlockSink(std::size_t line, std::vector<Event>& events, RunResult& result)
      : Sink(true),
        is_tool_unused(result.is_tool_unused),
        line_(line),
        events_(events),
        registers_(result.registers),
        state_(result.state) {}

  std::optional<syntax::Finding> error;
  bool is_tool_unused;                        ///< After the block.
  std::optional<Registers> registers_before;  ///< Before the block, if it has set one.

  void report(const syntax::Finding& finding) override {
    if (!error && is_error(finding)) error = finding;
  }
  void move(const execution::ProgrammedMove& move, const execution::State& state) override {
    if (move.kind != execution::MoveKind::Rapid) is_tool_unused = false;
    add(execution::in_machine(move, state));
  }
  void dwell(double seconds) override { add(DwellEvent{seconds}); }
  void spindle_speed(double speed) override { add(SpindleSpeedEvent{speed}); }
  void function(int m, std::span<const execution::FunctionParameter> parameters) override {
    if (dialect::is_user_function(m)) is_tool_unused = false;
    add(FunctionEvent{m, {parameters.begin(), parameters.end()}});
  }
  void tool_change(execution::ToolCode tool) override {
    is_tool_unused = tool.head != 0;
    add(ToolEvent{tool});
  }
  void frame_changed(const execution::State& state) override {
    add(FrameEvent{state.workpiece_origin, state.face_mounted, state.face, state.frame_in_force()});
  }
  void assign(int reg, double value) override {
    if (!registers_before) registers_before = registers_;
    if (!std::isnan(value)) registers_[static_cast<std::size_t>(reg)] = value;
  }
  void exact_stop() override { add(ExactStopEvent{}); }
  void signal(const dialect::GCode& code) override { add(SignalEvent{&code}); }
  void end() override { add(EndEvent{}); }

 private:
  template <class What>
  void add(What what) {
    Event& event = events_.emplace_back();  // Filled in place: a motion is large.
    event.line = line_;
    event.what = std::move(what);
    event.is_in_inches = state_.in_inches();
  }

  std::size_t line_;
  std::vector<Event>& events_;
  Registers& registers_;
  const execution::State& state_;  ///< As far as the block has been executed.
};

}  // namespace

Runner::Runner(const Program& program, const RunOptions& options)
    : program_(&program), options_(&options), vgpl_(options.vgpl) {
  result_.state = execution::initial_state(options.setup);
  result_.registers = options.registers;
}

const syntax::LineTree& Runner::read_line() {
  if (!workbench_.holds_line) {
    const std::string_view text = program_->text();
    const char* const begin = text.data() + place_.offset;
    workbench_.store.clear();
    workbench_.line_end = workbench_.store.append_line(begin, text.data() + text.size());
    workbench_.tree = workbench_.store.tree(0, begin);
    workbench_.holds_line = true;
  }
  return workbench_.tree;
}

std::optional<Block> Runner::next() {
  if (has_ended_ || is_at_end_of_text() || is_at_until()) return std::nullopt;
  return Block{place_.line, read_line(),    result_.state,         result_.registers,
               vgpl_,       result_.blocks, result_.is_tool_unused};
}

/// Whether the next line is empty and has no error that stops the run.
bool Runner::empty_line_comes() {
  const auto block = next();
  if (!block || !block->tree.is_empty()) return false;
  const auto& findings = block->tree.findings;
  return !options_->stop_at_errors || std::none_of(findings.begin(), findings.end(), is_error);
}

void Runner::pass_empty_lines() {
  while (empty_line_comes()) step_line();
}

void Runner::step() {
  workbench_.events.clear();
  step_line();
}

void Runner::step_line() {
  if (has_ended_) return;
  if (is_at_end_of_text()) {
    const auto length = static_cast<std::uint32_t>(result_.line_text.size());
    return fail({.id = "m02-missing"_diag, .span = {0, length}});
  }
  if (is_at_until()) return end(Ending::Until, place_.line);
  const syntax::LineTree& tree = read_line();
  const bool has_text = !tree.words.empty() || !tree.comments.empty() || !tree.findings.empty();
  if (has_text) {
    result_.line = place_.line;
    result_.line_text = tree.text;
  }
  execute_line(tree);
}

/// Executes a line. Words after an IF on it (E002) are executed only if the IF does not jump (D56). Returns whether it
/// jumps.
bool Runner::execute_around_jump(const syntax::LineTree& tree, execution::Sink& sink) {
  const auto execute = [&](const syntax::LineTree& part) {
    execution::execute(part, result_.state, options_->setup, sink);
  };
  if (tree.jump == nullptr || !tree.jump->has_target || tree.findings.empty()) {
    execute(tree);
    return tree.jump != nullptr && is_taken(*tree.jump);
  }
  const execution::JumpLine parts = execution::around_jump(tree);
  execute(parts.before);
  const bool jumps = is_taken(*tree.jump);
  if (!jumps && !result_.state.ended) execute(parts.after);
  return jumps;
}

/// Executes the block of a line, or both where a line break is lost (D68), the second unless the first jumps or ends
/// the run. Returns their jumps; only the last may be taken.
std::vector<Runner::DecidedJump> Runner::execute_blocks(const syntax::LineTree& tree, execution::Sink& sink) {
  std::vector<DecidedJump> jumps;
  const auto execute_block = [&](const syntax::LineTree& block, std::uint32_t offset) {
    const bool jumps_on = execute_around_jump(block, sink);
    if (block.jump == nullptr || !block.jump->has_target) return;
    jumps.push_back({*block.jump, jumps_on});
    jumps.back().jump.shift(offset);
  };
  if (!tree.has(syntax::LineTree::kTwoBlocks)) {
    execute_block(tree, 0);
    return jumps;
  }
  std::uint32_t offset = 0;
  for (const std::string_view text : tree.blocks()) {
    if (result_.state.ended || (!jumps.empty() && jumps.back().is_taken)) break;
    const syntax::ParsedLine block(text);
    execute_block(block.tree(), offset);
    offset = static_cast<std::uint32_t>(text.size());
  }
  return jumps;
}

void Runner::execute_line(const syntax::LineTree& tree) {
  BlockSink sink(place_.line, workbench_.events, result_);
  for (const syntax::Finding& finding : tree.findings) sink.report(finding);
  const execution::State before = result_.state;
  const bool is_refused = sink.error && options_->stop_at_errors;
  const auto jumps = is_refused ? std::vector<DecidedJump>() : execute_blocks(tree, sink);
  if (sink.error && options_->stop_at_errors) {
    workbench_.events.clear();
    result_.state = before;
    if (sink.registers_before) result_.registers = *sink.registers_before;
    return fail(*sink.error);
  }
  result_.is_tool_unused = sink.is_tool_unused;
  if (!tree.is_empty()) ++result_.blocks;
  if (result_.state.ended) return end(Ending::ProgramEnd, result_.line);
  const std::string_view text = program_->text();
  const char* const below = text::skip_line_end(workbench_.line_end, text.data() + text.size());
  const LinePlace from = std::exchange(place_, {place_.line + 1, static_cast<std::size_t>(below - text.data())});
  workbench_.holds_line = false;
  for (const DecidedJump& each : jumps) branch(each.jump, each.is_taken, from);
}

/// Jumps to a line below with the label, or ends the run with an error (E004, E005).
void Runner::branch(const syntax::Jump& jump, bool is_taken, const LinePlace& from) {
  if (is_taken) {
    const std::optional<LinePlace> jump_target = program_->jump_target(from, jump.target);
    if (!jump_target) {
      const bool above = program_->has_label_above(from, jump.target);
      return fail({.id = above ? "backward-jump"_diag : "label-not-found"_diag, .span = jump.target_span});
    }
    place_ = *jump_target;
    if (options_->until && place_.line > *options_->until) result_.jumped_over_from = from.line;
  }
  workbench_.events.push_back({from.line, JumpEvent{is_taken, place_.line}});
}

bool Runner::is_taken(const syntax::Jump& jump) const {
  if (!jump.condition_is_known()) return false;
  const bool is_on_vgpl = jump.variable == syntax::Jump::kVgplVariable;
  return holds(jump, is_on_vgpl ? vgpl_ : result_.registers[static_cast<std::size_t>(jump.variable)]);
}

bool holds(const syntax::Jump& jump, double value) {
  using syntax::Comparison;
  if (!jump.condition_is_known()) return false;
  switch (jump.comparison) {
    case Comparison::Equal:
      return value == jump.value;
    case Comparison::NotEqual:
      return value != jump.value;
    case Comparison::Less:
      return value < jump.value;
    case Comparison::LessEqual:
      return value <= jump.value;
    case Comparison::Greater:
      return value > jump.value;
    case Comparison::GreaterEqual:
      return value >= jump.value;
    case Comparison::Invalid:
      break;
  }
  return false;
}

void Runner::end(Ending ending, std::size_t line) {
  result_.ending = ending;
  result_.line = line;
  has_ended_ = true;
}

void Runner::fail(const syntax::Finding& error) {
  result_.error = error;
  end(Ending::Error, result_.line);
}

RunResult run(std::string_view text, const RunOptions& options, const std::function<void(const Event&)>& on_event) {
  const Program program(text);
  Runner runner(program, options);
  constexpr std::uint32_t kLinesWithoutPause = 1024;
  for (std::uint32_t lines = 0; !runner.has_ended(); ++lines) {
    if (lines % kLinesWithoutPause == 0 && options.stop && options.stop()) {
      runner.stop();
      break;
    }
    if (options.before_block)
      if (const auto block = runner.next()) options.before_block(*block);
    runner.step();
    for (const Event& event : runner.events()) on_event(event);
  }
  return runner.result();
}

}  // namespace isocnc::running
