#include "debugger/requests/request.h"

namespace isocnc::requests {

/// Ends the run.
static void answer_terminate(Session& session) { session.terminate(); }

static Json terminate_capabilities() { return {{"supportsTerminateRequest", true}}; }

extern const DebugRequest terminate = on<&answer_terminate>("terminate", terminate_capabilities);

}  // namespace isocnc::requests
