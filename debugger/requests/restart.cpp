#include "debugger/requests/request.h"

namespace isocnc::requests {

namespace {

struct RestartArguments {
  std::optional<session::LaunchOptions> options;  ///< Those of the launch hold where there are none.
};

void from_json(const Json& json, RestartArguments& arguments) {
  const Json* const options = dap::find_member(json, "arguments");
  if (options != nullptr && options->is_object()) arguments.options = options->get<session::LaunchOptions>();
}

}  // namespace

/// From the start, or from the line that the launch asks for, with the program as the file says it now.
static void answer_restart(Session& session, const RestartArguments& arguments) { session.restart(arguments.options); }

static Json restart_capabilities() { return {{"supportsRestartRequest", true}}; }

extern const DebugRequest restart = on<&answer_restart>("restart", restart_capabilities);

}  // namespace isocnc::requests
