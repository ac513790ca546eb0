#include "debugger/requests/request.h"

namespace isocnc::debugger::requests {

/// Values that change (`V3`, `MOTION`, `F`), or that cross a threshold (`Z = 0`).
static Json answer_set_data_breakpoints(Session& session, const Json& arguments) {
  std::vector<session::DataBreakpoint> wanted;
  Json told = read_breakpoints(session, arguments, [&](const Json& each, std::int64_t id) {
    auto watched = session::Watched::compile(text(each, "dataId"), session.language());
    if (const auto* const problem = std::get_if<session::ExpressionProblem>(&watched))
      throw RequestError(problem->message);
    wanted.push_back(
        {{.id = id, .rules = rules_of(session, each), .counter = {}}, std::get<session::Watched>(std::move(watched))});
  });
  session.breakpoints().set_data(std::move(wanted));
  return told;
}

static Json set_data_breakpoints_capabilities() { return {{"supportsDataBreakpoints", true}}; }

extern const Request set_data_breakpoints = {.command = "setDataBreakpoints",
                                             .answer = answer_set_data_breakpoints,
                                             .capabilities = set_data_breakpoints_capabilities};

}  // namespace isocnc::debugger::requests
