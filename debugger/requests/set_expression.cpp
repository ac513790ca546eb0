#include "debugger/requests/request.h"
#include "debugger/session/console.h"

namespace isocnc::requests {

namespace {

struct SetExpressionArguments {
  std::string expression;
  std::string value;
  dap::FormatArguments format;
};

void from_json(const Json& json, SetExpressionArguments& arguments) {
  arguments.expression = required<std::string>(json, "expression");
  arguments.value = required<std::string>(json, "value");
  arguments.format = json.get<dap::FormatArguments>();
}

}  // namespace

/// What an expression names takes the value of another one.
static dap::ValueBody answer_set_expression(Session& session, const SetExpressionArguments& arguments) {
  const auto compiled = expressions::Expression::compile(arguments.expression, session.language());
  const auto* const expression = std::get_if<expressions::Expression>(&compiled);
  const expressions::Quantity* const quantity = expression != nullptr ? expression->sole_quantity() : nullptr;
  if (quantity == nullptr) session.refuse_to_set(arguments.expression);
  session.set_quantity(*quantity, session::number_of(session, arguments.value));
  return {expressions::show_value(quantity->at(session.moment()), format_of(session, arguments.format))};
}

static Json set_expression_capabilities() { return {{"supportsSetExpression", true}}; }

extern const DebugRequest set_expression = on<&answer_set_expression>("setExpression", set_expression_capabilities);

}  // namespace isocnc::requests
