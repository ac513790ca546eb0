#include "debugger/requests/request.h"

namespace isocnc::requests {

static constexpr dialect::Text kNoCode{"a code is M, G or T with its number, such as M06, G29 or T101001",
                                       "un codice è M, G o T con il suo numero, come M06, G29 o T101001"};

namespace {

struct FunctionBreakpointArguments {
  std::string code;
  dap::RuleArguments rules;
};

struct SetFunctionBreakpointsArguments {
  std::vector<Item<FunctionBreakpointArguments>> breakpoints;
};

void from_json(const Json& json, FunctionBreakpointArguments& arguments) {
  arguments.code = required<std::string>(json, "name");
  arguments.rules = json.get<dap::RuleArguments>();
}

void from_json(const Json& json, SetFunctionBreakpointsArguments& arguments) {
  if (auto breakpoints = member<std::vector<Item<FunctionBreakpointArguments>>>(json, "breakpoints"))
    arguments.breakpoints = *std::move(breakpoints);
}

}  // namespace

static breakpoints::FunctionBreakpoint make_function_breakpoint(const Session& session,
                                                                const FunctionBreakpointArguments& arguments,
                                                                std::int64_t id) {
  const auto code = breakpoints::WantedCode::read(arguments.code);
  if (!code) throw RequestError(std::string(session.in_language(kNoCode)));
  return {{.id = id, .rules = compile_rules(session, arguments.rules), .counter = {}}, *code};
}

/// Blocks that hold a code: `M06`, `T101001`, `G29`.
static BreakpointsBody answer_set_function_breakpoints(Session& session,
                                                       const SetFunctionBreakpointsArguments& arguments) {
  auto [breakpoints, body] = make_breakpoints<breakpoints::FunctionBreakpoint, FunctionBreakpointArguments>(
      session, arguments.breakpoints, [&](const FunctionBreakpointArguments& each, std::int64_t id) {
        return make_function_breakpoint(session, each, id);
      });
  session.breakpoints().set_functions(std::move(breakpoints));
  return body;
}

static Json set_function_breakpoints_capabilities() { return {{"supportsFunctionBreakpoints", true}}; }

extern const DebugRequest set_function_breakpoints =
    on<&answer_set_function_breakpoints>("setFunctionBreakpoints", set_function_breakpoints_capabilities);

}  // namespace isocnc::requests
