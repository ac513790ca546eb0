#include "debugger/requests/request.h"

namespace isocnc::requests {

/// One instruction of a block; on an arc in G49 one of the lines that it is driven as.
static void answer_step_in(Session& session) { session.step(dap::Step::Instruction); }

extern const DebugRequest step_in = on<&answer_step_in>("stepIn");

}  // namespace isocnc::requests
