#include "debugger/requests/request.h"

namespace isocnc::debugger::requests {

static constexpr dialect::Text kLine{"line {}", "riga {}"};

/// The block of a line, or the first one behind it. Its id is the line from 0.
static Json answer_goto_targets(Session& session, const Json& arguments) {
  Json targets = Json::array();
  const auto line = session.debuggee().text().executable_line(line_argument(session, arguments, "line"));
  if (line)
    targets.push_back({{"id", *line},
                       {"label", session.in_language(kLine, session.client().to_client_line(*line))},
                       {"line", session.client().to_client_line(*line)}});
  return {{"targets", targets}};
}

static Json goto_targets_capabilities() { return {{"supportsGotoTargetsRequest", true}}; }

extern const Request goto_targets = {
    .command = "gotoTargets", .answer = answer_goto_targets, .capabilities = goto_targets_capabilities};

}  // namespace isocnc::debugger::requests
