#include "debugger/requests/request.h"

namespace isocnc::requests {

static constexpr dialect::Text kOtherFile{"this is not the program that is debugged",
                                          "non è il programma in esecuzione"};
static constexpr dialect::Text kNoBlockFollows{"no block follows", "non segue nessun blocco"};

namespace {

struct LineBreakpointArguments {
  std::int64_t line = 0;
  Item<dap::RuleArguments> rules;  ///< Wrong ones leave the breakpoint in its line, unverified.
};

struct SetBreakpointsArguments {
  dap::SourceArguments source;
  std::vector<Item<LineBreakpointArguments>> breakpoints;
};

void from_json(const Json& json, LineBreakpointArguments& arguments) {
  arguments.line = required<std::int64_t>(json, "line");
  arguments.rules = json.get<Item<dap::RuleArguments>>();
}

/// Older clients send lines alone.
void from_json(const Json& json, SetBreakpointsArguments& arguments) {
  arguments.source = json.get<dap::SourceArguments>();
  auto breakpoints = member<std::vector<Item<LineBreakpointArguments>>>(json, "breakpoints");
  if (breakpoints || json.contains("breakpoints")) {
    arguments.breakpoints = std::move(breakpoints).value_or(std::vector<Item<LineBreakpointArguments>>());
    return;
  }
  for (const Json& line : member<std::vector<Json>>(json, "lines").value_or(std::vector<Json>()))
    arguments.breakpoints.push_back(Json{{"line", line}}.get<Item<LineBreakpointArguments>>());
}

}  // namespace

static breakpoints::SourceBreakpoint make_source_breakpoint(Session& session,
                                                            const Item<LineBreakpointArguments>& item) {
  breakpoints::SourceBreakpoint breakpoint;
  breakpoint.id = session.new_breakpoint_id();
  const LineBreakpointArguments& arguments = item.get();
  breakpoint.wanted_line = to_line(session, arguments.line);
  try {
    breakpoint.rules = compile_rules(session, arguments.rules.get());
  } catch (const RequestError& error) {
    breakpoint.problem = error.in(session.language());
  }
  return breakpoint;
}

static BreakpointBody body_of(const Session& session, const breakpoints::SourceBreakpoint& breakpoint) {
  BreakpointBody body{.id = breakpoint.id,
                      .is_verified = breakpoint.line.has_value(),
                      .message = breakpoint.problem,
                      .line = session.client().to_client_line(breakpoint.line.value_or(breakpoint.wanted_line)),
                      .source = session.source()};
  if (body.message.empty() && !body.is_verified) body.message = session.in_language(kNoBlockFollows);
  return body;
}

/// All breakpoints of a file, in place of those it had.
static BreakpointsBody answer_set_breakpoints(Session& session, const SetBreakpointsArguments& arguments) {
  session.debuggee();
  BreakpointsBody body;
  if (!session.is_program(arguments.source.path)) {
    const std::string message(session.in_language(kOtherFile));
    body.breakpoints.assign(arguments.breakpoints.size(), {.id = {}, .message = message, .line = {}, .source = {}});
    return body;
  }
  std::vector<breakpoints::SourceBreakpoint> breakpoints;
  for (const auto& each : arguments.breakpoints) breakpoints.push_back(make_source_breakpoint(session, each));
  for (const breakpoints::SourceBreakpoint& each : session.set_source_breakpoints(std::move(breakpoints)))
    body.breakpoints.push_back(body_of(session, each));
  return body;
}

static Json set_breakpoints_capabilities() {
  return {{"supportsConditionalBreakpoints", true},
          {"supportsHitConditionalBreakpoints", true},
          {"supportsLogPoints", true}};
}

extern const DebugRequest set_breakpoints = on<&answer_set_breakpoints>("setBreakpoints", set_breakpoints_capabilities);

}  // namespace isocnc::requests
