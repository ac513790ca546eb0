#include "debugger/requests/request.h"

namespace isocnc::requests {

/// Back to the last place at which the run would have stopped, or to its start.
static void answer_reverse_continue(Session& session) { session.reverse(); }

extern const DebugRequest reverse_continue = on<&answer_reverse_continue>("reverseContinue");

}  // namespace isocnc::requests
