#include "debugger/requests/request.h"
#include "debugger/session/console.h"
#include "debugger/session/variables.h"

namespace isocnc::requests {

namespace {

struct SetVariableArguments {
  std::string name;
  std::string value;
  std::int64_t reference = 0;  ///< Of the scope or variable that holds the name.
  dap::FormatArguments format;
};

void from_json(const Json& json, SetVariableArguments& arguments) {
  arguments.name = required<std::string>(json, "name");
  arguments.value = required<std::string>(json, "value");
  arguments.reference = required<std::int64_t>(json, "variablesReference");
  arguments.format = json.get<dap::FormatArguments>();
}

}  // namespace

/// A variable as the client shows it takes the value of an expression.
static dap::ValueBody answer_set_variable(Session& session, const SetVariableArguments& arguments) {
  const double value = session::number_of(session, arguments.value);
  for (const session::Variable& variable : session::variables_of(session, arguments.reference, {})) {
    if (variable.name != arguments.name || variable.quantity == nullptr) continue;
    session.set_quantity(*variable.quantity, value);
    return {expressions::show_value(variable.quantity->at(session.moment()), format_of(session, arguments.format))};
  }
  session.refuse_to_set(arguments.name);
}

static Json set_variable_capabilities() { return {{"supportsSetVariable", true}}; }

extern const DebugRequest set_variable = on<&answer_set_variable>("setVariable", set_variable_capabilities);

}  // namespace isocnc::requests
