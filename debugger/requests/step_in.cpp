#include "debugger/requests/request.h"

namespace isocnc::debugger::requests {

/// One instruction of a block; on an arc in G49 one of the lines that it is driven as.
static Json answer_step_in(Session& session, const Json&) {
  session.step(session::Step::Instruction);
  return nullptr;
}

extern const Request step_in = {.command = "stepIn", .answer = answer_step_in};

}  // namespace isocnc::debugger::requests
