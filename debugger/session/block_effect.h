#pragma once

#include <vector>

#include "interpreter/execution/machine_move.h"
#include "interpreter/running/runner.h"

namespace isocnc::debugger::session {

/// What a block would bring about.
struct BlockEffect {
  execution::State state;        ///< Behind it.
  running::Registers registers;  ///< Behind it.
  std::vector<execution::MachineMove> moves;
  std::vector<geometry::Pose> on_arc;  ///< Points on the way along an arc, the extreme ones, too; frame in force.
  bool has_error = false;              ///< Then it does nothing of that.
};

/// Whether the block drives an arc, unless it is wrong.
bool may_be_arc(const running::Block& block);

/// Whether the block holds an M06.
bool changes_tool(const running::Block& block);

BlockEffect effect_of(const running::Block& block, const execution::Setup& setup);

}  // namespace isocnc::debugger::session
