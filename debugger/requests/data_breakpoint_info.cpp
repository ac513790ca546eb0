#include "debugger/requests/request.h"
#include "debugger/session/variables.h"

namespace isocnc::debugger::requests {

static constexpr dialect::Text kUnwatchable{"this cannot be watched", "non si può sorvegliare"};

/// The expression that a variable of the client's is; empty where it is none.
static std::string expression_of(const Session& session, const std::string& name, std::int64_t reference) {
  for (const session::Variable& variable : session::variables_of(session, reference, {}))
    if (variable.name == name) return variable.evaluate_name;
  return {};
}

/// Whether something can be watched: a variable, or an expression such as `V3` or `Z = 0`, which is its own id.
static Json answer_data_breakpoint_info(Session& session, const Json& arguments) {
  std::string name = text(arguments, "name");
  const std::int64_t reference = find_integer(arguments, "variablesReference").value_or(0);
  if (reference > 0) name = expression_of(session, name, reference);
  const auto watched = session::Watched::compile(name, session.language());
  if (const auto* const problem = std::get_if<session::ExpressionProblem>(&watched))
    return {{"dataId", nullptr},
            {"description", name.empty() ? std::string(session.in_language(kUnwatchable)) : problem->message}};
  return {{"dataId", name}, {"description", name}, {"accessTypes", {"write"}}, {"canPersist", true}};
}

extern const Request data_breakpoint_info = {.command = "dataBreakpointInfo", .answer = answer_data_breakpoint_info};

}  // namespace isocnc::debugger::requests
