#include "debugger/requests/request.h"

namespace isocnc::debugger::requests {

/// Ends the run.
static Json answer_terminate(Session& session, const Json&) {
  session.terminate();
  return nullptr;
}

static Json terminate_capabilities() { return {{"supportsTerminateRequest", true}}; }

extern const Request terminate = {
    .command = "terminate", .answer = answer_terminate, .capabilities = terminate_capabilities};

}  // namespace isocnc::debugger::requests
