#include "debugger/requests/request.h"

namespace isocnc::requests {

static constexpr dialect::Text kNoTarget{"there is no such target", "non c'è un tale punto di arrivo"};

namespace {

struct GotoArguments {
  std::int64_t target = 0;  ///< The line, from 0.
};

void from_json(const Json& json, GotoArguments& arguments) {
  arguments.target = required<std::int64_t>(json, "targetId");
}

}  // namespace

/// Forward or backward to a line, with the state that a run to it has.
static void answer_go_to(Session& session, const GotoArguments& arguments) {
  const auto line = static_cast<std::size_t>(arguments.target);
  if (arguments.target < 0 || line >= session.debuggee().text().line_count())
    throw RequestError(std::string(session.in_language(kNoTarget)));
  session.go_to_line(line);
}

extern const DebugRequest go_to = on<&answer_go_to>("goto");

}  // namespace isocnc::requests
