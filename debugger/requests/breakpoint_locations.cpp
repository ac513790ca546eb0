#include "debugger/requests/request.h"

namespace isocnc::debugger::requests {

/// Lines that a client is told of at once.
static constexpr std::size_t kMost = 10000;

/// Lines that do something.
static Json answer_breakpoint_locations(Session& session, const Json& arguments) {
  const session::ProgramText& program = session.debuggee().text();
  const std::uint64_t first = line_argument(session, arguments, "line");
  const std::uint64_t last = find_integer(arguments, "endLine") ? line_argument(session, arguments, "endLine") : first;
  Json locations = Json::array();
  const Json source = arguments.value("source", Json::object());
  if (!session.is_program(find_text(source, "path").value_or(""))) return {{"breakpoints", locations}};
  for (auto line = program.executable_line(first); line && *line <= last && locations.size() < kMost;
       line = program.executable_line(*line + 1))
    locations.push_back({{"line", session.client().to_client_line(*line)}});
  return {{"breakpoints", locations}};
}

static Json breakpoint_locations_capabilities() { return {{"supportsBreakpointLocationsRequest", true}}; }

extern const Request breakpoint_locations = {.command = "breakpointLocations",
                                             .answer = answer_breakpoint_locations,
                                             .capabilities = breakpoint_locations_capabilities};

}  // namespace isocnc::debugger::requests
