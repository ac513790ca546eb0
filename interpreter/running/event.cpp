#include "interpreter/running/event.h"

#include <fmt/format.h>
#include <cmath>
#include <type_traits>

#include <nlohmann/json.hpp>

#include "interpreter/running/vector_json.h"

namespace isocnc::running {

using OrderedJson = nlohmann::ordered_json;
using execution::MoveKind;

namespace {

void put(OrderedJson& json, const MoveEvent& move) {
  json["from"] = array(move.from);
  json["to"] = array(move.to);
  if (move.kind == MoveKind::Arc) {
    json["center"] = array(move.center);
    json["normal"] = array(move.normal);
    json["radius"] = move.radius;
    json["sweepDeg"] = move.sweep_deg;
  }
  json["lengthMm"] = move.length;
}
void put(OrderedJson& json, const DwellEvent& dwell) { json["seconds"] = dwell.seconds; }
void put(OrderedJson& json, const SpindleSpeedEvent& spindle) { json["speed"] = spindle.speed; }
void put(OrderedJson& json, const FunctionEvent& function) {
  json["number"] = function.number;
  if (function.parameters.empty()) return;
  for (const execution::FunctionParameter& parameter : function.parameters)
    json["parameters"]["P" + std::to_string(parameter.number)] = parameter.value;
}
void put(OrderedJson& json, const ToolEvent& event) {
  json["head"] = event.tool.head;
  json["holder"] = event.tool.holder;
  json["tool"] = event.tool.tool;
}
void put(OrderedJson& json, const FrameEvent& frame) {
  json["workpiece"] = array(frame.workpiece_origin);
  json["face"] = nullptr;
  if (!frame.face_mounted) return;
  json["face"] = {{"origin", array(frame.face.origin)},
                  {"i", array(geometry::Vec3(frame.face.axes.col(0)))},
                  {"j", array(geometry::Vec3(frame.face.axes.col(1)))},
                  {"k", array(geometry::Vec3(frame.face.axes.col(2)))}};
}
void put(OrderedJson& json, const JumpEvent& jump) {
  json["taken"] = jump.taken;
  json["target"] = jump.target_line + 1;
}
void put(OrderedJson&, const SignalEvent&) {}
/// Any other event says all by its kind.
template <class What>
void put(OrderedJson&, const What&) {
  static_assert(std::is_empty_v<What>);
}

template <class What>
std::string_view kind(const What&) {
  return What::kKind;
}
std::string_view kind(const MoveEvent& move) {
  constexpr std::string_view kKinds[] = {"rapid", "feed", "arc"};
  return kKinds[static_cast<std::size_t>(move.kind)];
}
std::string_view kind(const FunctionEvent& function) {
  return dialect::is_user_function(function.number) ? "m" : "spindle";
}

std::string_view kind(const SignalEvent& signal) { return signal.code->signal.kind; }

template <class What>
constexpr bool stops(const What&) {
  return requires { What::kStopsReading; };
}
bool stops(const SignalEvent& signal) { return signal.code->signal.stops_reading; }

}  // namespace

std::string_view kind_of(const Event& event) {
  return std::visit([](const auto& what) { return kind(what); }, event.what);
}

bool stops_reading(const Event& event) {
  return std::visit([](const auto& what) { return stops(what); }, event.what);
}

double feed_of(const MoveEvent& move) {
  if (!move.inverse_time) return move.feed;
  const double degrees = std::hypot(move.to.b - move.from.b, move.to.c - move.from.c);
  return move.feed * (move.length > 0 ? move.length : degrees);
}

std::string tool_name(const execution::ToolCode& tool) {
  return fmt::format("T{}{:02}{:03}", tool.head, tool.holder, tool.tool);
}

std::string to_json(const Event& event) { return to_json(event, {}); }

std::string to_json(const Event& event, std::span<const std::pair<std::string_view, double>> more) {
  OrderedJson json;
  json["line"] = event.line + 1;
  json["kind"] = kind_of(event);
  std::visit([&](const auto& what) { put(json, what); }, event.what);
  for (const auto& [key, value] : more) json[std::string(key)] = value;
  return json.dump();
}

}  // namespace isocnc::running
