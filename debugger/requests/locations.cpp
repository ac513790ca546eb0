#include "debugger/session/locations.h"
#include "debugger/requests/request.h"

namespace isocnc::requests {

namespace {

struct LocationsArguments {
  std::int64_t reference = 0;
};

void from_json(const Json& json, LocationsArguments& arguments) {
  arguments.reference = required<std::int64_t>(json, "locationReference");
}

}  // namespace

/// Where the value of a variable was set, or an obstacle is described.
static Json answer_locations(Session& session, const LocationsArguments& arguments) {
  return session::location(session, arguments.reference);
}

extern const DebugRequest locations = on<&answer_locations>("locations");

}  // namespace isocnc::requests
