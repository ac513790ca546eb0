#include "debugger/session/block_effect.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "interpreter/execution/execute.h"
#include "interpreter/geometry/helix.h"

namespace isocnc::debugger::session {

namespace {

/// Every few degrees, and where X, Y and Z turn around.
std::vector<geometry::Pose> points_on(const execution::Move& arc) {
  constexpr double kStep = std::numbers::pi / 32;
  const geometry::Helix helix = geometry::helix(arc.from.tip, arc.to.tip, arc.center, arc.normal, arc.sweep_deg);
  std::vector<double> angles;
  for (double angle = kStep; angle < helix.sweep; angle += kStep) angles.push_back(angle);
  for (int axis = 0; axis < 3; ++axis)
    for (double angle = std::atan2(helix.side[axis], helix.out[axis]); angle < helix.sweep; angle += std::numbers::pi)
      if (angle > 0) angles.push_back(angle);
  std::sort(angles.begin(), angles.end());
  std::vector<geometry::Pose> points;
  for (const double angle : angles) {
    const double part = angle / helix.sweep;
    points.push_back({helix.center + std::cos(angle) * helix.out + std::sin(angle) * helix.side + part * helix.rise,
                      std::lerp(arc.from.b, arc.to.b, part), std::lerp(arc.from.c, arc.to.c, part)});
  }
  return points;
}

class Scout final : public execution::Sink {
 public:
  explicit Scout(BlockEffect& effect) : Sink(true), effect_(effect) {}

  void report(const syntax::Finding& finding) override {
    effect_.has_error |= dialect::definition(finding.id).severity == dialect::Severity::Error;
  }
  void move(const execution::Move& move, const execution::State& state) override {
    effect_.moves.push_back(execution::in_machine(move, state));
    if (move.kind == execution::MoveKind::Arc && move.sweep_deg != 0) effect_.on_arc = points_on(move);
  }
  void assign(int number, double value) override {
    if (!std::isnan(value)) effect_.registers[static_cast<std::size_t>(number)] = value;
  }

 private:
  BlockEffect& effect_;
};

}  // namespace

bool may_be_arc(const running::Block& block) {
  const std::uint8_t motion = block.state.mode(dialect::ModalGroup::Motion);
  if (motion != dialect::kNoMotion && motion >= 2) return true;
  return std::any_of(block.tree.instructions.begin(), block.tree.instructions.end(),
                     [](const syntax::Instruction& each) { return each.g() != nullptr && each.g()->is_arc(); });
}

bool changes_tool(const running::Block& block) {
  return std::any_of(block.tree.instructions.begin(), block.tree.instructions.end(),
                     [](const syntax::Instruction& each) { return each.kind == syntax::InstructionKind::ToolChange; });
}

BlockEffect effect_of(const running::Block& block, const execution::Setup& setup) {
  BlockEffect effect{.state = block.state, .registers = block.registers, .moves = {}, .on_arc = {}};
  Scout scout(effect);
  for (const syntax::Finding& finding : block.tree.findings) scout.report(finding);
  execution::execute(block.tree, effect.state, setup, scout);
  return effect;
}

}  // namespace isocnc::debugger::session
