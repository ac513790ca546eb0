#include "debugger/requests/request.h"
#include "debugger/session/variables.h"

namespace isocnc::requests {

/// The same for each frame: there is one machine.
static Json answer_scopes(Session& session) {
  session.stopped_debuggee();
  Json scopes = Json::array();
  for (const session::Scope& scope : session::scopes_of(session)) {
    Json json = {{"name", session.in_language(scope.name)},
                 {"variablesReference", scope.reference},
                 {"expensive", scope.is_expensive}};
    if (!scope.hint.empty()) json["presentationHint"] = scope.hint;
    scopes.push_back(json);
  }
  return {{"scopes", scopes}};
}

extern const DebugRequest scopes = on<&answer_scopes>("scopes");

}  // namespace isocnc::requests
