#include "debugger/requests/request.h"

namespace isocnc::requests {

namespace {

struct DataBreakpointArguments {
  std::string expression;
  dap::RuleArguments rules;
};

struct SetDataBreakpointsArguments {
  std::vector<Item<DataBreakpointArguments>> breakpoints;
};

void from_json(const Json& json, DataBreakpointArguments& arguments) {
  arguments.expression = required<std::string>(json, "dataId");
  arguments.rules = json.get<dap::RuleArguments>();
}

void from_json(const Json& json, SetDataBreakpointsArguments& arguments) {
  if (auto breakpoints = member<std::vector<Item<DataBreakpointArguments>>>(json, "breakpoints"))
    arguments.breakpoints = *std::move(breakpoints);
}

}  // namespace

static breakpoints::DataBreakpoint make_data_breakpoint(const Session& session,
                                                        const DataBreakpointArguments& arguments, std::int64_t id) {
  auto watched = expressions::WatchedValue::compile(arguments.expression, session.language());
  if (const auto* const problem = std::get_if<expressions::ExpressionProblem>(&watched))
    throw RequestError(problem->message);
  return {{.id = id, .rules = compile_rules(session, arguments.rules), .counter = {}},
          std::get<expressions::WatchedValue>(std::move(watched))};
}

/// Values that change (`V3`, `MOTION`, `F`), or that cross a threshold (`Z = 0`).
static BreakpointsBody answer_set_data_breakpoints(Session& session, const SetDataBreakpointsArguments& arguments) {
  auto [breakpoints, body] = make_breakpoints<breakpoints::DataBreakpoint, DataBreakpointArguments>(
      session, arguments.breakpoints,
      [&](const DataBreakpointArguments& each, std::int64_t id) { return make_data_breakpoint(session, each, id); });
  session.breakpoints().set_data(std::move(breakpoints));
  return body;
}

static Json set_data_breakpoints_capabilities() { return {{"supportsDataBreakpoints", true}}; }

extern const DebugRequest set_data_breakpoints =
    on<&answer_set_data_breakpoints>("setDataBreakpoints", set_data_breakpoints_capabilities);

}  // namespace isocnc::requests
