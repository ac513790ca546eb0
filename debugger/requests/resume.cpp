#include "debugger/requests/request.h"

namespace isocnc::requests {

/// Up to the next stop.
static Json answer_resume(Session& session) {
  session.resume();
  return {{"allThreadsContinued", true}};
}

extern const DebugRequest resume = on<&answer_resume>("continue");

}  // namespace isocnc::requests
