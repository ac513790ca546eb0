#include "debugger/requests/request.h"

namespace isocnc::requests {

/// The client has set its breakpoints: the run may begin.
static void answer_configuration_done(Session& session) { session.configuration_done(); }

static Json configuration_done_capabilities() { return {{"supportsConfigurationDoneRequest", true}}; }

extern const DebugRequest configuration_done =
    on<&answer_configuration_done>("configurationDone", configuration_done_capabilities);

}  // namespace isocnc::requests
