#include "debugger/requests/request.h"

namespace isocnc::debugger::requests {

/// Back to the last thing that would have stopped the run, or to its begin.
static Json answer_reverse_continue(Session& session, const Json&) {
  session.reverse();
  return nullptr;
}

extern const Request reverse_continue = {.command = "reverseContinue", .answer = answer_reverse_continue};

}  // namespace isocnc::debugger::requests
