#include "debugger/session/block_effect.h"

#include <cmath>

#include "interpreter/execution/execute.h"

namespace isocnc::debugger::session {

namespace {

class Scout final : public execution::Sink {
 public:
  explicit Scout(BlockEffect& effect) : Sink(true), effect_(effect) {}

  void report(const syntax::Finding& finding) override {
    effect_.has_error |= dialect::definition(finding.id).severity == dialect::Severity::Error;
  }
  void move(const execution::Move& move, const execution::State& state) override {
    effect_.moves.push_back(execution::in_machine(move, state));
  }
  void assign(int number, double value) override {
    if (!std::isnan(value)) effect_.registers[static_cast<std::size_t>(number)] = value;
  }

 private:
  BlockEffect& effect_;
};

}  // namespace

BlockEffect effect_of(const running::Block& block, const execution::Setup& setup) {
  BlockEffect effect{.state = block.state, .registers = block.registers, .moves = {}};
  Scout scout(effect);
  for (const syntax::Finding& finding : block.tree.findings) scout.report(finding);
  execution::execute(block.tree, effect.state, setup, scout);
  return effect;
}

}  // namespace isocnc::debugger::session
