#include "debugger/requests/request.h"

namespace isocnc::requests {

/// Reads the program; the run begins when the client has set its breakpoints.
static void answer_launch(Session& session, const session::LaunchOptions& options) { session.launch(options); }

extern const DebugRequest launch = on<&answer_launch>("launch");

}  // namespace isocnc::requests
