#include "debugger/requests/request.h"

namespace isocnc::requests {

static constexpr dialect::Text kMachine{"machine", "macchina"};

/// The machine does one thing at a time.
static Json answer_threads(Session& session) {
  return {{"threads", {{{"id", 1}, {"name", session.in_language(kMachine)}}}}};
}

extern const DebugRequest threads = on<&answer_threads>("threads");

}  // namespace isocnc::requests
