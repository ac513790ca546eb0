#include "debugger/requests/request.h"
#include "debugger/session/console.h"
#include "debugger/session/variables.h"

namespace isocnc::debugger::requests {

/// A variable as the client shows it takes the value of an expression.
static Json answer_set_variable(Session& session, const Json& arguments) {
  const std::string name = text(arguments, "name");
  const double value = session::number_of(session, text(arguments, "value"));
  for (const session::Variable& variable :
       session::variables_of(session, integer(arguments, "variablesReference"), {})) {
    if (variable.name != name || variable.quantity == nullptr) continue;
    session.set_quantity(*variable.quantity, value);
    return {{"value", session::show_value(variable.quantity->at(session.moment()), format_of(session, arguments))}};
  }
  session.refuse_to_set(name);
}

static Json set_variable_capabilities() { return {{"supportsSetVariable", true}}; }

extern const Request set_variable = {
    .command = "setVariable", .answer = answer_set_variable, .capabilities = set_variable_capabilities};

}  // namespace isocnc::debugger::requests
