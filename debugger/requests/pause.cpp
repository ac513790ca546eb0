#include "debugger/requests/request.h"

namespace isocnc::debugger::requests {

/// Where the machine is just now.
static Json answer_pause(Session& session, const Json&) {
  session.pause();
  return nullptr;
}

extern const Request pause = {.command = "pause", .answer = answer_pause};

}  // namespace isocnc::debugger::requests
