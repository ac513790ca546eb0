#include "debugger/requests/request.h"
#include "debugger/session/console.h"

namespace isocnc::debugger::requests {

/// What an expression names takes the value of another one.
static Json answer_set_expression(Session& session, const Json& arguments) {
  const std::string name = text(arguments, "expression");
  const auto compiled = session::Expression::compile(name, session.language());
  const auto* const expression = std::get_if<session::Expression>(&compiled);
  const session::Quantity* const quantity = expression != nullptr ? expression->sole_quantity() : nullptr;
  if (quantity == nullptr) session.refuse_to_set(name);
  session.set_quantity(*quantity, session::number_of(session, text(arguments, "value")));
  return {{"value", session::show_value(quantity->at(session.moment()), format_of(session, arguments))}};
}

static Json set_expression_capabilities() { return {{"supportsSetExpression", true}}; }

extern const Request set_expression = {
    .command = "setExpression", .answer = answer_set_expression, .capabilities = set_expression_capabilities};

}  // namespace isocnc::debugger::requests
