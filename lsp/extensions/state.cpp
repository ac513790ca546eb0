#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "interpreter/text/unicode.h"
#include "lsp/extensions/extension.h"
#include "lsp/protocol/uri.h"
#include "lsp/queries/line_run.h"
#include "lsp/queries/state_table.h"

/// The modal state and the position before and after a line: as data by our own request `isocnc/state`, and as a text
/// for people.
namespace isocnc::extensions {
namespace {

struct StateParams : protocol::DocumentParams {
  std::uint32_t line = 0;
};

void from_json(const Json& json, StateParams& params) {
  from_json(json, static_cast<protocol::DocumentParams&>(params));
  // Read as the line of a position, so that the same numbers are valid.
  params.line = Json{{"line", json.at("line")}, {"character", 0u}}.get<ClientPosition>().line;
}

struct StateResult {
  std::optional<queries::LineRun> run;
};

Json vector_json(const geometry::Vec3& vector) { return {{"x", vector.x()}, {"y", vector.y()}, {"z", vector.z()}}; }

/// The position as JSON; an axis whose position is unknown because of an error is null.
Json position_json(const execution::State& state) {
  const geometry::Pose& pose = state.position;
  const double values[] = {pose.tip.x(), pose.tip.y(), pose.tip.z(), pose.b, pose.c};
  Json json;
  for (int axis = 0; axis < execution::kAxisCount; ++axis) {
    const bool is_known = (state.unknown & execution::axis_bit(static_cast<execution::Axis>(axis))) == 0;
    json[std::string(1, "xyzbc"[axis])] = is_known ? Json(values[axis]) : Json();
  }
  return json;
}

Json state_json(const execution::State& state) {
  Json in_force;
  for (std::size_t i = 0; i < dialect::kModalGroupCount; ++i) {
    const dialect::GCode* const code = state.g(static_cast<dialect::ModalGroup>(i));
    in_force[dialect::kModalGroups[i].key] = code ? Json(code->number) : Json();
  }
  const bool knows_place = (state.unknown & execution::kLinearAxes) == 0 && state.is_frame_known();
  Json json = {{"inForce", in_force},
               {"position", position_json(state)},
               {"machinePosition", knows_place ? vector_json(state.to_machine(state.position.tip)) : Json()},
               {"workpieceOrigin", vector_json(state.workpiece_origin)},
               {"faceMounted", state.face_mounted},
               {"spindle", {{"function", state.spindle_function}, {"speed", state.spindle_speed}}},
               {"tool", nullptr},
               {"feed", nullptr}};
  const execution::ProgrammedFeed feed = execution::feed_in_force(state);
  if (state.feed_given) json["feed"] = feed.number * feed.mm_per_unit;
  if (state.tool != execution::ToolCode{})
    json["tool"] = fmt::format("{:d}{:02d}{:03d}", state.tool.head, state.tool.holder, state.tool.tool);
  return json;
}

void to_json(Json& json, const StateResult& result) {
  json = {{"before", result.run ? state_json(result.run->before) : Json()},
          {"after", result.run ? state_json(result.run->after) : Json()}};
}

StateResult answer_state(const Snapshot& snapshot, const StateParams& params) {
  return {queries::run_line(snapshot, params.line)};
}

/// The table of a line, or why there is none.
std::string table_of(const Snapshot& snapshot, std::size_t line) {
  static constexpr dialect::Text kNoLine = {"There is no such line.", "Questa riga non c'è."};
  static constexpr dialect::Text kNoPath = {"No path leads here.", "Nessun percorso arriva qui."};
  static constexpr dialect::Text kTooMany = {"Too many paths lead here.", "Troppi percorsi arrivano qui."};
  const dialect::Language language = snapshot.language();
  const auto sentence = [&](const dialect::Text& text) { return std::string(text.in(language)) + "\n"; };
  if (line >= snapshot.document().line_count()) return sentence(kNoLine);
  if (const auto run = queries::run_line(snapshot, line)) return queries::state_table(*run, language);
  const std::vector<queries::LineRun> runs = queries::run_line_on_all_paths(snapshot, line);
  if (!runs.empty()) return queries::state_table(runs, language);
  return sentence(queries::is_never_reached(snapshot, line) ? kNoPath : kTooMany);
}

/// A heading with the line as it stands in the program, and the table.
TextContent write_state(const Snapshot& snapshot, const TextParams& params) {
  if (!params.line) throw rpc::Error(rpc::ErrorCode::InvalidParams, "a state is that at a line, which is missing");
  std::string heading = fmt::format("{}:{}", protocol::name_in(snapshot.uri()), *params.line + std::size_t{1});
  if (*params.line < snapshot.document().line_count())
    heading += "  " + text::printable(snapshot.document().line(*params.line)->text);
  return {fmt::format("{}\n\n{}", heading, table_of(snapshot, *params.line))};
}

}  // namespace

extern const features::Feature state = {.methods = {on<&answer_state>("isocnc/state")},
                                        .texts = {on<&write_state>("state")}};

}  // namespace isocnc::extensions
