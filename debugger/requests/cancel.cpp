#include "debugger/requests/request.h"

namespace isocnc::requests {

namespace {

struct CancelArguments {
  std::optional<std::string> progress_id;
};

void from_json(const Json& json, CancelArguments& arguments) {
  arguments.progress_id = member<std::string>(json, "progressId");
}

}  // namespace

/// Stops a search that has reported its progress. Requests are answered at once: there is none to be cancelled.
static void answer_cancel(Session& session, const CancelArguments& arguments) {
  if (arguments.progress_id && session.is_running()) session.pause();
}

static Json cancel_capabilities() { return {{"supportsCancelRequest", true}}; }

extern const DebugRequest cancel = on<&answer_cancel>("cancel", cancel_capabilities);

}  // namespace isocnc::requests
