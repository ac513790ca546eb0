#include "debugger/requests/request.h"

namespace isocnc::debugger::requests {

/// All breakpoints have been told: the run may begin.
static Json answer_configuration_done(Session& session, const Json&) {
  session.configuration_done();
  return nullptr;
}

static Json configuration_done_capabilities() { return {{"supportsConfigurationDoneRequest", true}}; }

extern const Request configuration_done = {.command = "configurationDone",
                                           .answer = answer_configuration_done,
                                           .capabilities = configuration_done_capabilities};

}  // namespace isocnc::debugger::requests
