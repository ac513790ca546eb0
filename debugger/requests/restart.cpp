#include "debugger/requests/request.h"

namespace isocnc::debugger::requests {

/// From the begin, or from the line that the launch asks for, with the program as the file says it now.
static Json answer_restart(Session& session, const Json& arguments) {
  const Json launch_arguments = arguments.value("arguments", Json());
  if (launch_arguments.is_object()) {
    session.restart(session::read_launch_options(launch_arguments, session.language()));
  } else {
    session.restart(std::nullopt);
  }
  return nullptr;
}

static Json restart_capabilities() { return {{"supportsRestartRequest", true}}; }

extern const Request restart = {.command = "restart", .answer = answer_restart, .capabilities = restart_capabilities};

}  // namespace isocnc::debugger::requests
