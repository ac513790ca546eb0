#include "debugger/requests/request.h"

namespace isocnc::debugger::requests {

/// To the end of the tool's section, or of the frame.
static Json answer_step_out(Session& session, const Json&) {
  session.step_out();
  return nullptr;
}

extern const Request step_out = {.command = "stepOut", .answer = answer_step_out};

}  // namespace isocnc::debugger::requests
