#include "debugger/requests/request.h"

namespace isocnc::debugger::requests {

/// Up to the next thing that stops the run.
static Json answer_resume(Session& session, const Json&) {
  session.resume();
  return {{"allThreadsContinued", true}};
}

extern const Request resume = {.command = "continue", .answer = answer_resume};

}  // namespace isocnc::debugger::requests
