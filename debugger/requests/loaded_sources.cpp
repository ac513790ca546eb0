#include "debugger/requests/request.h"

namespace isocnc::debugger::requests {

/// The program: it is all there is.
static Json answer_loaded_sources(Session& session, const Json&) {
  if (!session.is_launched()) return {{"sources", Json::array()}};
  return {{"sources", {session.source()}}};
}

static Json loaded_sources_capabilities() { return {{"supportsLoadedSourcesRequest", true}}; }

extern const Request loaded_sources = {
    .command = "loadedSources", .answer = answer_loaded_sources, .capabilities = loaded_sources_capabilities};

}  // namespace isocnc::debugger::requests
