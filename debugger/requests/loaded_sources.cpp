#include "debugger/requests/request.h"

namespace isocnc::requests {

/// The program, which is the only source.
static Json answer_loaded_sources(Session& session) {
  if (!session.is_launched()) return {{"sources", Json::array()}};
  return {{"sources", {session.source()}}};
}

static Json loaded_sources_capabilities() { return {{"supportsLoadedSourcesRequest", true}}; }

extern const DebugRequest loaded_sources = on<&answer_loaded_sources>("loadedSources", loaded_sources_capabilities);

}  // namespace isocnc::requests
