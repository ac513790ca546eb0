#include "debugger/requests/request.h"

namespace isocnc::requests {

/// To the start of the block, or of the one before; or back by an instruction.
static void answer_step_back(Session& session, const dap::StepArguments& arguments) {
  session.step_back(arguments.step);
}

static Json step_back_capabilities() { return {{"supportsStepBack", true}}; }

extern const DebugRequest step_back = on<&answer_step_back>("stepBack", step_back_capabilities);

}  // namespace isocnc::requests
