#include "debugger/requests/request.h"
#include "debugger/session/console.h"
#include "interpreter/syntax/characters.h"

namespace isocnc::debugger::requests {

/// `X10.5` under the mouse: the X there is now.
static std::string hovered(const Session& session, const std::string& word, const session::ValueFormat& format) {
  if (session::find_quantity(word) == nullptr && word.size() > 1 &&
      session::find_quantity(word.substr(0, 1)) != nullptr && syntax::is_number_char(word[1]))
    return session::evaluate(session, word.substr(0, 1), format);
  return session::evaluate(session, word, format);
}

/// An expression; in the console also blocks to be run by hand.
static Json answer_evaluate(Session& session, const Json& arguments) {
  const std::string expression = text(arguments, "expression");
  const std::string context = find_text(arguments, "context").value_or("watch");
  const session::ValueFormat format = format_of(session, arguments);
  if (!session.is_launched()) session.stopped_debuggee();
  const std::string result = context == "repl"    ? session::enter(session, expression)
                             : context == "hover" ? hovered(session, expression, format)
                                                  : session::evaluate(session, expression, format);
  return {{"result", result}, {"variablesReference", 0}};
}

static Json evaluate_capabilities() {
  return {{"supportsEvaluateForHovers", true}, {"supportsClipboardContext", true}};
}

extern const Request evaluate = {
    .command = "evaluate", .answer = answer_evaluate, .capabilities = evaluate_capabilities};

}  // namespace isocnc::debugger::requests
