#include "debugger/requests/request.h"

namespace isocnc::debugger::requests {

/// The machine does one thing at a time.
static Json answer_threads(Session& session, const Json&) {
  static constexpr dialect::Text kMachine{"machine", "macchina"};
  return {{"threads", {{{"id", 1}, {"name", session.in_language(kMachine)}}}}};
}

extern const Request threads = {.command = "threads", .answer = answer_threads};

}  // namespace isocnc::debugger::requests
