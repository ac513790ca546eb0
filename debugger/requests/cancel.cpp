#include "debugger/requests/request.h"

namespace isocnc::debugger::requests {

/// Of a search that has told its progress. Requests are answered at once: there is none to be cancelled.
static Json answer_cancel(Session& session, const Json& arguments) {
  if (find_text(arguments, "progressId") && session.is_running()) session.pause();
  return nullptr;
}

static Json cancel_capabilities() { return {{"supportsCancelRequest", true}}; }

extern const Request cancel = {.command = "cancel", .answer = answer_cancel, .capabilities = cancel_capabilities};

}  // namespace isocnc::debugger::requests
