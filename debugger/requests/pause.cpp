#include "debugger/requests/request.h"

namespace isocnc::requests {

/// Stops the machine where it is.
static void answer_pause(Session& session) { session.pause(); }

extern const DebugRequest pause = on<&answer_pause>("pause");

}  // namespace isocnc::requests
