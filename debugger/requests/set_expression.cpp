#include "debugger/requests/request.h"
#include "debugger/session/console.h"

namespace isocnc::debugger::requests {

namespace {

struct SetExpressionArguments {
  std::string expression;
  std::string value;
  session::FormatArguments format;
};

void from_json(const Json& json, SetExpressionArguments& arguments) {
  arguments.expression = required<std::string>(json, "expression");
  arguments.value = required<std::string>(json, "value");
  arguments.format = json.get<session::FormatArguments>();
}

}  // namespace

/// What an expression names takes the value of another one.
static session::ValueBody answer_set_expression(Session& session, const SetExpressionArguments& arguments) {
  const auto compiled = session::Expression::compile(arguments.expression, session.language());
  const auto* const expression = std::get_if<session::Expression>(&compiled);
  const session::Quantity* const quantity = expression != nullptr ? expression->sole_quantity() : nullptr;
  if (quantity == nullptr) session.refuse_to_set(arguments.expression);
  session.set_quantity(*quantity, session::number_of(session, arguments.value));
  return {session::show_value(quantity->at(session.moment()), format_of(session, arguments.format))};
}

static Json set_expression_capabilities() { return {{"supportsSetExpression", true}}; }

extern const DebugRequest set_expression = on<&answer_set_expression>("setExpression", set_expression_capabilities);

}  // namespace isocnc::debugger::requests
