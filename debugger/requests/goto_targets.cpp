#include "debugger/requests/request.h"

namespace isocnc::requests {

static constexpr dialect::Text kLine{"line {}", "riga {}"};

namespace {

struct GotoTargetsArguments {
  std::int64_t line = 0;
};

struct GotoTarget {
  std::size_t id = 0;  ///< The line, from 0.
  std::string label;
  std::int64_t line = 0;  ///< As the client counts.
};

struct GotoTargetsBody {
  std::vector<GotoTarget> targets;
};

void from_json(const Json& json, GotoTargetsArguments& arguments) {
  arguments.line = required<std::int64_t>(json, "line");
}

void to_json(Json& json, const GotoTargetsBody& body) {
  json = {{"targets", Json::array()}};
  for (const GotoTarget& each : body.targets)
    json["targets"].push_back({{"id", each.id}, {"label", each.label}, {"line", each.line}});
}

}  // namespace

/// The block of a line, or the first one after it.
static GotoTargetsBody answer_goto_targets(Session& session, const GotoTargetsArguments& arguments) {
  const debuggee::ProgramText& program = session.debuggee().text();
  const auto line = program.executable_line(to_line(session, arguments.line));
  if (!line) return {};
  const std::int64_t shown = session.client().to_client_line(*line);
  return {{{.id = *line, .label = session.in_language(kLine, shown), .line = shown}}};
}

static Json goto_targets_capabilities() { return {{"supportsGotoTargetsRequest", true}}; }

extern const DebugRequest goto_targets = on<&answer_goto_targets>("gotoTargets", goto_targets_capabilities);

}  // namespace isocnc::requests
