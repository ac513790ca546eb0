#include "debugger/requests/request.h"

namespace isocnc::debugger::requests {

/// Reads the program; the run begins when the client has told its breakpoints.
static Json answer_launch(Session& session, const Json& arguments) {
  session.launch(session::read_launch_options(arguments, session.language()));
  return nullptr;
}

extern const Request launch = {.command = "launch", .answer = answer_launch};

}  // namespace isocnc::debugger::requests
