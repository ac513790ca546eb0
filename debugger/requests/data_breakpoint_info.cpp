#include "debugger/requests/request.h"
#include "debugger/session/variables.h"

namespace isocnc::requests {

static constexpr dialect::Text kUnwatchable{"this cannot be watched", "non si può sorvegliare"};

namespace {

struct DataInfoArguments {
  std::string name;
  std::int64_t reference = 0;  ///< Of the scope or variable that holds the name; 0 where it is an expression.
};

struct DataInfoBody {
  std::optional<std::string> id;  ///< None where it cannot be watched.
  std::string description;
};

void from_json(const Json& json, DataInfoArguments& arguments) {
  arguments.name = required<std::string>(json, "name");
  arguments.reference = member<std::int64_t>(json, "variablesReference").value_or(0);
}

void to_json(Json& json, const DataInfoBody& body) {
  json = {{"dataId", nullptr}, {"description", body.description}};
  if (body.id) json.update({{"dataId", *body.id}, {"accessTypes", {"write"}}, {"canPersist", true}});
}

}  // namespace

/// The expression of a variable that the client shows; empty where it is none.
static std::string expression_of(const Session& session, const std::string& name, std::int64_t reference) {
  for (const session::Variable& variable : session::variables_of(session, reference, {}))
    if (variable.name == name) return variable.evaluate_name;
  return {};
}

/// Whether something can be watched: a variable, or an expression such as `V3` or `Z = 0`, which is its own id.
static DataInfoBody answer_data_breakpoint_info(Session& session, const DataInfoArguments& arguments) {
  const std::string name =
      arguments.reference > 0 ? expression_of(session, arguments.name, arguments.reference) : arguments.name;
  const auto watched = expressions::WatchedValue::compile(name, session.language());
  const auto* const problem = std::get_if<expressions::ExpressionProblem>(&watched);
  if (problem == nullptr) return {.id = name, .description = name};
  return {.id = {}, .description = name.empty() ? std::string(session.in_language(kUnwatchable)) : problem->message};
}

extern const DebugRequest data_breakpoint_info = on<&answer_data_breakpoint_info>("dataBreakpointInfo");

}  // namespace isocnc::requests
