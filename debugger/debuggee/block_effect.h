#pragma once

#include <vector>

#include "interpreter/execution/machine_move.h"
#include "interpreter/running/runner.h"

namespace isocnc::debuggee {

/// The effects of a block.
struct BlockEffect {
  execution::State state;        ///< The state after it.
  running::Registers registers;  ///< The registers after it.
  std::vector<execution::MachineMove> moves;
  std::vector<geometry::Pose> on_arc;  ///< Points along an arc, the extreme ones among them; frame in force.
  bool has_error = false;              ///< Whether the block is wrong, so that it does nothing of the above.
};

/// Whether the block drives an arc, unless it is wrong.
bool may_be_arc(const running::Block& block);

/// Whether the block holds an M06.
bool changes_tool(const running::Block& block);

BlockEffect effect_of(const running::Block& block, const execution::Setup& setup);

}  // namespace isocnc::debuggee
