#include "debugger/requests/request.h"

namespace isocnc::requests {

/// One block, or, where the client asks for it, one of its instructions.
static void answer_next(Session& session, const dap::StepArguments& arguments) { session.step(arguments.step); }

static Json next_capabilities() { return {{"supportsSteppingGranularity", true}}; }

extern const DebugRequest next = on<&answer_next>("next", next_capabilities);

}  // namespace isocnc::requests
