#include "debugger/requests/request.h"

namespace isocnc::debugger::requests {

static constexpr dialect::Text kNoCode{"a code is M, G or T with its number, such as M06, G29 or T101001",
                                       "un codice è M, G o T con il suo numero, come M06, G29 o T101001"};

/// Blocks that hold a code: `M06`, `T101001`, `G29`.
static Json answer_set_function_breakpoints(Session& session, const Json& arguments) {
  std::vector<session::FunctionBreakpoint> wanted;
  Json told = read_breakpoints(session, arguments, [&](const Json& each, std::int64_t id) {
    const auto code = session::WantedCode::read(text(each, "name"));
    if (!code) throw RequestError(std::string(session.in_language(kNoCode)));
    wanted.push_back({{.id = id, .rules = rules_of(session, each), .counter = {}}, *code});
  });
  session.breakpoints().set_functions(std::move(wanted));
  return told;
}

static Json set_function_breakpoints_capabilities() { return {{"supportsFunctionBreakpoints", true}}; }

extern const Request set_function_breakpoints = {.command = "setFunctionBreakpoints",
                                                 .answer = answer_set_function_breakpoints,
                                                 .capabilities = set_function_breakpoints_capabilities};

}  // namespace isocnc::debugger::requests
