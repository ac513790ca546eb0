#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "interpreter/running/event.h"
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

/// The states before and after a line, on each path that leads to it.
struct StateResult {
  std::vector<queries::LineRun> runs;
};

/// A member of a state: `position` and `x`; the first is empty for a member of the state itself.
struct StateMember {
  std::string object;
  std::string name;
  std::optional<Json> value;  ///< Nothing where it is not known.
};

/// All members of a state, the same ones for each.
std::vector<StateMember> members_of(const execution::State& state) {
  std::vector<StateMember> members;
  const auto add = [&](std::string object, std::string name, bool is_known, Json value) {
    members.push_back({std::move(object), std::move(name), is_known ? std::optional(std::move(value)) : std::nullopt});
  };
  for (std::size_t i = 0; i < dialect::kModalGroupCount; ++i) {
    const auto group = static_cast<dialect::ModalGroup>(i);
    const dialect::GCode* const code = state.g(group);
    const bool is_illegible = group == dialect::ModalGroup::Motion && state.motion_illegible;
    add("inForce", std::string(dialect::kModalGroups[i].key), !is_illegible && !state.is_in_doubt(group),
        code ? Json(code->number) : Json());
  }
  const geometry::Pose& pose = state.position;
  const double values[] = {pose.tip.x(), pose.tip.y(), pose.tip.z(), pose.b, pose.c};
  const auto has = [](execution::AxisSet axes, int axis) {
    return (axes & execution::axis_bit(static_cast<execution::Axis>(axis))) != 0;
  };
  for (int axis = 0; axis < execution::kAxisCount; ++axis)
    add("position", std::string(1, "xyzbc"[axis]), !has(state.unknown, axis), values[axis]);
  const bool knows_place = (state.unknown & execution::kLinearAxes) == 0 && state.is_frame_known();
  const geometry::Vec3 place = state.to_machine(state.position.tip);
  for (int axis = 0; axis < 3; ++axis) add("machinePosition", std::string(1, "xyz"[axis]), knows_place, place[axis]);
  for (int axis = 0; axis < 3; ++axis)
    add("workpieceOrigin", std::string(1, "xyz"[axis]), !has(state.workpiece_unknown, axis),
        state.workpiece_origin[axis]);
  add("", "faceMounted", !state.is_in_doubt(dialect::ModalGroup::Face), state.face_mounted);
  add("spindle", "function", state.spindle != execution::Spindle::Unknown, state.spindle_function);
  add("spindle", "speed", state.speed_known, state.spindle_speed);
  const bool has_tool = state.tool != execution::ToolCode{};
  add("", "tool", state.tool_known || !has_tool, has_tool ? Json(running::tool_name(state.tool).substr(1)) : Json());
  const execution::ProgrammedFeed feed = execution::feed_in_force(state);
  add("", "feed", feed.is_known || !state.feed_given, state.feed_given ? Json(feed.number * feed.mm_per_unit) : Json());
  return members;
}

/// What the states of all runs agree on. What is not known, or differs from path to path, is null, and named in
/// `unknown`; an object of which nothing is known is null itself.
Json agreed_state(const std::vector<queries::LineRun>& runs, const execution::State queries::LineRun::*state) {
  if (runs.empty()) return {};
  std::vector<StateMember> agreed = members_of(runs.front().*state);
  for (const queries::LineRun& run : runs) {
    const std::vector<StateMember> members = members_of(run.*state);
    for (std::size_t i = 0; i < agreed.size(); ++i)
      if (agreed[i].value != members[i].value) agreed[i].value.reset();
  }
  Json json = {{"unknown", Json::array()}};
  for (const StateMember& member : agreed) {
    Json& object = member.object.empty() ? json : json[member.object];
    object[member.name] = member.value.value_or(Json());
    if (!member.value)
      json["unknown"].push_back(member.object.empty() ? member.name : member.object + "." + member.name);
  }
  const Json& place = json.at("machinePosition");
  if (std::all_of(place.begin(), place.end(), [](const Json& each) { return each.is_null(); }))
    json["machinePosition"] = Json();
  return json;
}

void to_json(Json& json, const StateResult& result) {
  json = {{"before", agreed_state(result.runs, &queries::LineRun::before)},
          {"after", agreed_state(result.runs, &queries::LineRun::after)}};
}

StateResult answer_state(const Snapshot& snapshot, const StateParams& params) {
  return {queries::run_line_on_all_paths(snapshot, params.line)};
}

/// The table of a line, or why there is none.
std::string table_of(const Snapshot& snapshot, std::size_t line) {
  static constexpr dialect::Text kNoLine = {"There is no such line.", "Questa riga non c'è."};
  static constexpr dialect::Text kNoPath = {"No path leads here.", "Nessun percorso arriva qui."};
  static constexpr dialect::Text kTooMany = {"Too many paths lead here.", "Troppi percorsi arrivano qui."};
  const dialect::Language language = snapshot.language();
  const auto sentence = [&](const dialect::Text& text) { return std::string(text.in(language)) + "\n"; };
  if (line >= snapshot.document().line_count()) return sentence(kNoLine);
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
