#include "debugger/requests/request.h"

namespace isocnc::debugger::requests {

/// To the begin of the block, or of the one before; or back by an instruction.
static Json answer_step_back(Session& session, const Json& arguments) {
  session.step_back(find_text(arguments, "granularity") == "instruction" ? session::Step::Instruction
                                                                         : session::Step::Block);
  return nullptr;
}

static Json step_back_capabilities() { return {{"supportsStepBack", true}}; }

extern const Request step_back = {
    .command = "stepBack", .answer = answer_step_back, .capabilities = step_back_capabilities};

}  // namespace isocnc::debugger::requests
