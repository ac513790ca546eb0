#include "debugger/requests/request.h"

namespace isocnc::requests {

/// To the end of the tool's section, or of the frame.
static void answer_step_out(Session& session) { session.step_out(); }

extern const DebugRequest step_out = on<&answer_step_out>("stepOut");

}  // namespace isocnc::requests
