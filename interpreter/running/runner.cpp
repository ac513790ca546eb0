#include "interpreter/running/runner.h"

#include "interpreter/execution/execute.h"
#include "interpreter/syntax/characters.h"
#include "interpreter/syntax/tree_store.h"

namespace isocnc::running {

using namespace dialect::literals;

namespace {

/// Gathers what one block does, so that a block in error does nothing.
class BlockSink final : public execution::Sink {
 public:
  BlockSink(std::vector<Event>& events, Registers& registers) : Sink(true), events_(events), registers_(registers) {}

  std::uint64_t line = 0;
  std::optional<syntax::Finding> error;

  void report(const syntax::Finding& finding) override {
    if (!error && dialect::definition(finding.id).severity == dialect::Severity::Error) error = finding;
  }
  void move(const execution::Move& move, const execution::State& state) override {
    add(execution::in_machine(move, state));
  }
  void dwell(double seconds) override { add(DwellEvent{seconds}); }
  void spindle_speed(double speed) override { add(SpindleSpeedEvent{speed}); }
  void function(int m, std::span<const execution::FunctionParameter> parameters) override {
    add(FunctionEvent{m, {parameters.begin(), parameters.end()}});
  }
  void tool_change(execution::ToolCode tool) override { add(ToolEvent{tool}); }
  void frame_changed(const execution::State& state) override {
    add(FrameEvent{state.workpiece_origin, state.face_mounted, state.face});
  }
  void assign(int reg, double value) override {
    if (!std::isnan(value)) registers_[static_cast<std::size_t>(reg)] = value;
  }
  void exact_stop() override { add(ExactStopEvent{}); }
  void end() override { add(EndEvent{}); }

 private:
  template <class What>
  void add(What what) {
    events_.push_back({line, std::move(what)});
  }

  std::vector<Event>& events_;
  Registers& registers_;
};

class Runner {
 public:
  Runner(std::string_view text, const RunOptions& options, const std::function<void(const Event&)>& on_event)
      : text_(text), options_(options), on_event_(on_event), sink_(events_, result_.registers) {
    result_.state = execution::initial_state(options.setup);
    result_.registers = options.registers;
  }

  RunResult run() {
    const char* p = text_.data();
    const char* const end = text_.data() + text_.size();
    bool goes_on = true;
    for (; p != end && goes_on; ++line_) {
      if (options_.until && line_ >= *options_.until) {
        result_.ending = Ending::Until;
        result_.line = line_;
        return result_;
      }
      store_.clear();
      const char* const line_end = store_.append_line(p, end);
      tree_ = store_.tree(0, p);
      goes_on = step();
      p = syntax::skip_line_end(line_end, end);
    }
    if (goes_on) reach_end_of_file();
    return result_;
  }

 private:
  /// Executes the line just read; false when the run is over.
  bool step() {
    const bool has_text = !tree_.words.empty() || !tree_.comments.empty() || !tree_.findings.empty();
    if (has_text) note_place(tree_.text);
    if (waiting_for_) {
      if (!tree_.has_label() || tree_.label != waiting_for_->target) return true;
      land();
    }
    if (options_.before_block) options_.before_block({line_, tree_, result_.state, result_.registers});
    events_.clear();
    sink_.line = line_;
    sink_.error.reset();
    const Registers registers_before = result_.registers;
    for (const syntax::Finding& finding : tree_.findings) sink_.report(finding);
    const execution::State before = result_.state;
    if (!sink_.error || !options_.stop_at_errors) execution::execute(tree_, result_.state, options_.setup, sink_);
    if (sink_.error && options_.stop_at_errors) {
      result_.state = before;
      result_.registers = registers_before;
      return fail(*sink_.error);
    }
    if (!tree_.is_empty()) ++result_.blocks;
    for (const Event& event : events_) on_event_(event);
    if (result_.state.ended) {
      result_.ending = Ending::ProgramEnd;
      return false;
    }
    if (tree_.jump && tree_.jump->has_target) branch(*tree_.jump);
    return true;
  }

  void note_place(std::string_view text) {
    result_.line = line_;
    result_.line_text = text;
  }

  bool fail(const syntax::Finding& error) {
    result_.ending = Ending::Error;
    result_.error = error;
    return false;
  }

  struct Waiting {
    std::uint64_t target;
    std::uint64_t line;
    std::string_view text;
    syntax::Span span;
  };

  void branch(const syntax::Jump& jump) {
    if (!holds(jump)) return on_event_({line_, JumpEvent{false, line_ + 1}});
    waiting_for_ = Waiting{jump.target, line_, tree_.text, jump.target_span};
  }

  void land() {
    on_event_({waiting_for_->line, JumpEvent{true, line_}});
    waiting_for_.reset();
  }

  bool holds(const syntax::Jump& jump) const {
    using syntax::Comparison;
    if (!jump.condition_is_known()) return false;
    const double left = jump.variable == syntax::Jump::kVgplVariable
                            ? options_.vgpl
                            : result_.registers[static_cast<std::size_t>(jump.variable)];
    switch (jump.comparison) {
      case Comparison::Equal:
        return left == jump.value;
      case Comparison::NotEqual:
        return left != jump.value;
      case Comparison::Less:
        return left < jump.value;
      case Comparison::LessEqual:
        return left <= jump.value;
      case Comparison::Greater:
        return left > jump.value;
      case Comparison::GreaterEqual:
        return left >= jump.value;
      case Comparison::Invalid:
        break;
    }
    return false;
  }

  /// No M02 (ISO045), or a jump whose label is not below it (E004, E005).
  void reach_end_of_file() {
    if (!waiting_for_) {
      fail({.id = "m02-missing"_diag, .span = {0, static_cast<std::uint32_t>(result_.line_text.size())}});
      return;
    }
    result_.line = waiting_for_->line;
    result_.line_text = waiting_for_->text;
    const bool above = label_stands_above(waiting_for_->target);
    fail({.id = above ? "backward-jump"_diag : "label-not-found"_diag, .span = waiting_for_->span});
  }

  bool label_stands_above(std::uint64_t label) {
    const char* p = text_.data();
    const char* const end = text_.data() + text_.size();
    for (std::uint64_t line = 0; line <= waiting_for_->line && p != end; ++line) {
      store_.clear();
      const char* const line_end = store_.append_line(p, end);
      const syntax::LineTree tree = store_.tree(0, p);
      if (tree.has_label() && tree.label == label) return true;
      p = syntax::skip_line_end(line_end, end);
    }
    return false;
  }

  std::string_view text_;
  const RunOptions& options_;
  const std::function<void(const Event&)>& on_event_;
  RunResult result_;
  std::vector<Event> events_;  // Of one block.
  BlockSink sink_;
  syntax::TreeStore store_;
  syntax::LineTree tree_;
  std::uint64_t line_ = 0;
  std::optional<Waiting> waiting_for_;
};

}  // namespace

RunResult run(std::string_view text, const RunOptions& options, const std::function<void(const Event&)>& on_event) {
  return Runner(text, options, on_event).run();
}

}  // namespace isocnc::running
