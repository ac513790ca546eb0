#include "debugger/session/variables.h"
#include "debugger/requests/request.h"

namespace isocnc::requests {

namespace {

struct VariablesArguments {
  std::int64_t reference = 0;
  dap::FormatArguments format;
  bool wants_indexed = false;
  dap::PageArguments page;
};

struct VariablesBody {
  std::vector<session::Variable> variables;
};

void from_json(const Json& json, VariablesArguments& arguments) {
  arguments.reference = required<std::int64_t>(json, "variablesReference");
  arguments.format = json.get<dap::FormatArguments>();
  arguments.wants_indexed = member<std::string>(json, "filter") == "indexed";
  arguments.page.start = member<std::int64_t>(json, "start").value_or(0);
  arguments.page.count = member<std::int64_t>(json, "count").value_or(0);
}

Json json_of(const session::Variable& variable) {
  Json json = {{"name", variable.name}, {"value", variable.value}, {"variablesReference", variable.reference}};
  if (!variable.type.empty()) json["type"] = variable.type;
  if (!variable.evaluate_name.empty()) json["evaluateName"] = variable.evaluate_name;
  if (variable.location > 0) json["valueLocationReference"] = variable.location;
  if (variable.quantity == nullptr) json["presentationHint"] = {{"attributes", {"readOnly"}}};
  return json;
}

void to_json(Json& json, const VariablesBody& body) {
  json = {{"variables", Json::array()}};
  for (const session::Variable& each : body.variables) json["variables"].push_back(json_of(each));
}

}  // namespace

/// What a scope or a variable holds; a part of it where the client pages. No variable is indexed.
static VariablesBody answer_variables(Session& session, const VariablesArguments& arguments) {
  const auto all = session::variables_of(session, arguments.reference, format_of(session, arguments.format));
  if (arguments.wants_indexed) return {};
  const auto [begin, end] = arguments.page.of(all.size());
  return {{all.begin() + static_cast<std::ptrdiff_t>(begin), all.begin() + static_cast<std::ptrdiff_t>(end)}};
}

static Json variables_capabilities() { return {{"supportsValueFormattingOptions", true}}; }

extern const DebugRequest variables = on<&answer_variables>("variables", variables_capabilities);

}  // namespace isocnc::requests
