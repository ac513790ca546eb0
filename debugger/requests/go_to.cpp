#include "debugger/requests/request.h"

namespace isocnc::debugger::requests {

static constexpr dialect::Text kNoTarget{"there is no such target", "non c'è un tale punto di arrivo"};

/// Back or on to a line, with the state that a run to it has.
static Json answer_go_to(Session& session, const Json& arguments) {
  const std::int64_t target = integer(arguments, "targetId");
  const bool is_line = target >= 0 && static_cast<std::uint64_t>(target) < session.debuggee().text().line_count();
  if (!is_line) throw RequestError(std::string(session.in_language(kNoTarget)));
  session.go_to_line(static_cast<std::uint64_t>(target));
  return nullptr;
}

extern const Request go_to = {.command = "goto", .answer = answer_go_to};

}  // namespace isocnc::debugger::requests
