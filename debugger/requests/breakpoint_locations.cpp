#include "debugger/requests/request.h"

namespace isocnc::requests {

/// Maximum number of lines in a response.
static constexpr std::size_t kMaxLocations = 10000;

namespace {

struct LocationArguments {
  dap::SourceArguments source;
  std::int64_t line = 0;
  std::optional<std::int64_t> end_line;
};

struct LocationsBody {
  std::vector<std::int64_t> lines;  ///< As the client counts.
};

void from_json(const Json& json, LocationArguments& arguments) {
  arguments.line = required<std::int64_t>(json, "line");
  arguments.end_line = member<std::int64_t>(json, "endLine");
  arguments.source = json.get<dap::SourceArguments>();
}

void to_json(Json& json, const LocationsBody& body) {
  json = {{"breakpoints", Json::array()}};
  for (const std::int64_t line : body.lines) json["breakpoints"].push_back({{"line", line}});
}

}  // namespace

/// Lines that do something.
static LocationsBody answer_breakpoint_locations(Session& session, const LocationArguments& arguments) {
  const debuggee::ProgramText& program = session.debuggee().text();
  const std::size_t first = to_line(session, arguments.line);
  const std::size_t last = arguments.end_line ? to_line(session, *arguments.end_line) : first;
  LocationsBody body;
  if (!session.is_program(arguments.source.path)) return body;
  for (auto line = program.executable_line(first); line && *line <= last && body.lines.size() < kMaxLocations;
       line = program.executable_line(*line + 1))
    body.lines.push_back(session.client().to_client_line(*line));
  return body;
}

static Json breakpoint_locations_capabilities() { return {{"supportsBreakpointLocationsRequest", true}}; }

extern const DebugRequest breakpoint_locations =
    on<&answer_breakpoint_locations>("breakpointLocations", breakpoint_locations_capabilities);

}  // namespace isocnc::requests
