#include "debugger/debuggee/block_effect.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "interpreter/execution/block_recorder.h"
#include "interpreter/geometry/helix.h"

namespace isocnc::debuggee {

namespace {

/// Every few degrees, and where X, Y and Z turn around.
std::vector<geometry::Pose> points_on(const execution::ProgrammedMove& arc) {
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

}  // namespace

bool may_be_arc(const running::Block& block) {
  if (const dialect::GCode* const motion = block.state.motion(); motion != nullptr && motion->is_arc()) return true;
  return std::any_of(block.tree.instructions.begin(), block.tree.instructions.end(),
                     [](const syntax::Instruction& each) { return each.g() != nullptr && each.g()->is_arc(); });
}

bool changes_tool(const running::Block& block) {
  return std::any_of(block.tree.instructions.begin(), block.tree.instructions.end(),
                     [](const syntax::Instruction& each) { return each.kind == syntax::InstructionKind::ToolChange; });
}

BlockEffect effect_of(const running::Block& block, const execution::Setup& setup) {
  const execution::BlockRecorder done(block.tree, block.state, setup);
  BlockEffect effect{
      .state = done.state(), .registers = block.registers, .moves = {}, .on_arc = {}, .has_error = done.has_error()};
  for (const auto& [move, state] : done.motions()) {
    effect.moves.push_back(execution::in_machine(move, state));
    if (move.kind == execution::MoveKind::Arc && move.sweep_deg != 0) effect.on_arc = points_on(move);
  }
  for (const auto& [reg, value] : done.assignments())
    if (!std::isnan(value)) effect.registers[static_cast<std::size_t>(reg)] = value;
  return effect;
}

}  // namespace isocnc::debuggee
