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
  bool has_error = false;  ///< Then it does nothing of that.
};

BlockEffect effect_of(const running::Block& block, const execution::Setup& setup);

}  // namespace isocnc::debugger::session
