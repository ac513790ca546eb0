#include "debugger/requests/request.h"
#include "debugger/session/console.h"
#include "interpreter/text/characters.h"

namespace isocnc::requests {

namespace {

struct EvaluateArguments {
  std::string expression;
  std::string context;  ///< `repl`, `hover`, `watch`.
  dap::FormatArguments format;
};

struct EvaluateBody {
  std::string result;
  std::int64_t location = 0;  ///< Reference of the place where the value was set; 0 for none.
};

void from_json(const Json& json, EvaluateArguments& arguments) {
  arguments.expression = required<std::string>(json, "expression");
  arguments.context = member<std::string>(json, "context").value_or("watch");
  arguments.format = json.get<dap::FormatArguments>();
}

void to_json(Json& json, const EvaluateBody& body) {
  json = {{"result", body.result}, {"variablesReference", 0}};
  if (body.location > 0) json["valueLocationReference"] = body.location;
}

}  // namespace

/// `X10.5` under the mouse: the present X.
static std::string hovered(const Session& session, const std::string& word, const expressions::ValueFormat& format) {
  if (expressions::find_quantity(word) == nullptr && word.size() > 1 &&
      expressions::find_quantity(word.substr(0, 1)) != nullptr && text::is_number_char(word[1]))
    return session::evaluate(session, word.substr(0, 1), format);
  return session::evaluate(session, word, format);
}

/// An expression; in the console also blocks to be run by hand.
static EvaluateBody answer_evaluate(Session& session, const EvaluateArguments& arguments) {
  const expressions::ValueFormat format = format_of(session, arguments.format);
  session.debuggee();
  EvaluateBody body;
  if (arguments.context == "repl") {
    body.result = session::enter(session, arguments.expression);
  } else if (arguments.context == "hover") {
    body.result = hovered(session, arguments.expression, format);
  } else {
    body.result = session::evaluate(session, arguments.expression, format);
  }
  if (const expressions::Quantity* const quantity = expressions::find_quantity(arguments.expression))
    body.location = session.location_of(*quantity);
  return body;
}

static Json evaluate_capabilities() {
  return {{"supportsEvaluateForHovers", true}, {"supportsClipboardContext", true}};
}

extern const DebugRequest evaluate = on<&answer_evaluate>("evaluate", evaluate_capabilities);

}  // namespace isocnc::requests
