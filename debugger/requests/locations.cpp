#include "debugger/expressions/locations.h"

#include <filesystem>

#include "debugger/requests/request.h"
#include "interpreter/system/paths.h"
#include "interpreter/text/unicode.h"

namespace isocnc::requests {

static constexpr dialect::Text kNowhere{"no place has the reference {}", "nessun punto ha il riferimento {}"};

namespace {

struct LocationsArguments {
  std::int64_t reference = 0;
};

void from_json(const Json& json, LocationsArguments& arguments) {
  arguments.reference = required<std::int64_t>(json, "locationReference");
}

}  // namespace

static Json in_other_file(const Session& session, const dialect::FilePlace& place) {
  const std::filesystem::path file = system::absolute(place.file);
  return {{"source", {{"name", file.filename().generic_string()}, {"path", system::generic_name(file)}}},
          {"line", session.client().to_client_line(place.line)}};
}

/// Where the value of a variable was set, or an obstacle is described.
static Json answer_locations(Session& session, const LocationsArguments& arguments) {
  const debuggee::Debuggee& debuggee = session.stopped_debuggee();
  const auto place = expressions::find_location(arguments.reference, debuggee, session.surroundings());
  if (!place) throw RequestError(session.in_language(kNowhere, arguments.reference));
  if (place->other_file) return in_other_file(session, *place->other_file);
  const dap::ClientProfile& client = session.client();
  Json json = {{"source", session.source()}, {"line", client.to_client_line(place->line)}};
  if (!place->word) return json;
  const std::string_view text = debuggee.text().line(place->line);
  json["column"] = client.to_client_column(text::column_of(text, place->word->begin) - 1);
  json["endLine"] = json["line"];
  json["endColumn"] = client.to_client_column(text::column_of(text, place->word->end) - 1);
  return json;
}

extern const DebugRequest locations = on<&answer_locations>("locations");

}  // namespace isocnc::requests
