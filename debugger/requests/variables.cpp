#include <algorithm>

#include "debugger/requests/request.h"
#include "debugger/session/variables.h"

namespace isocnc::debugger::requests {

static Json to_json(const session::Variable& variable) {
  Json json = {{"name", variable.name}, {"value", variable.value}, {"variablesReference", variable.reference}};
  if (!variable.type.empty()) json["type"] = variable.type;
  if (!variable.evaluate_name.empty()) json["evaluateName"] = variable.evaluate_name;
  if (variable.quantity == nullptr) json["presentationHint"] = {{"attributes", {"readOnly"}}};
  return json;
}

/// What a scope or a variable holds; a part of it where the client pages.
static Json answer_variables(Session& session, const Json& arguments) {
  const auto all =
      session::variables_of(session, integer(arguments, "variablesReference"), format_of(session, arguments));
  const auto size = static_cast<std::int64_t>(all.size());
  const bool wants_indexed = find_text(arguments, "filter") == "indexed";
  const std::int64_t begin = std::clamp<std::int64_t>(find_integer(arguments, "start").value_or(0), 0, size);
  const std::int64_t count = find_integer(arguments, "count").value_or(0);
  const std::int64_t end = count > 0 && count < size - begin ? begin + count : size;
  Json variables = Json::array();
  for (std::int64_t i = begin; i < end && !wants_indexed; ++i)
    variables.push_back(to_json(all[static_cast<std::size_t>(i)]));
  return {{"variables", variables}};
}

static Json variables_capabilities() { return {{"supportsValueFormattingOptions", true}}; }

extern const Request variables = {
    .command = "variables", .answer = answer_variables, .capabilities = variables_capabilities};

}  // namespace isocnc::debugger::requests
