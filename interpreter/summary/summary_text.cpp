#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "interpreter/dialect/format.h"
#include "interpreter/running/error_message.h"
#include "interpreter/summary/summary.h"

namespace isocnc::summary {

using dialect::Language;
using dialect::Text;
using execution::State;
using OrderedJson = nlohmann::ordered_json;

std::string shown_time(double seconds) {
  const double tenths = std::round(seconds * 10);
  const double minutes = std::floor(tenths / 600);
  const double hours = std::floor(minutes / 60);
  const double rest = (tenths - minutes * 600) / 10;
  if (hours > 0) return fmt::format("{:.0f} h {:02.0f} min {:04.1f} s", hours, minutes - hours * 60, rest);
  if (minutes > 0) return fmt::format("{:.0f} min {:04.1f} s", minutes, rest);
  return fmt::format("{:.1f} s", rest);
}

static constexpr Text kEndings[] = {{"ran to M02", "eseguito fino a M02"},
                                    {"stopped by an error", "fermato da un errore"},
                                    {"stopped where asked", "fermato dove richiesto"}};
static constexpr Text kResult{"result: {}, line {}", "esito: {}, riga {}"};
static constexpr Text kJumpedOverLine{" (the IF of line {} jumps over the line asked for)",
                                      " (l'IF della riga {} scavalca la riga richiesta)"};
static constexpr Text kCycleTime{"cycle time: ", "tempo ciclo: "};
static constexpr Text kWorks[] = {
    {"rapids", "rapidi"},          {"feed moves", "lineari"},          {"arcs", "archi"},
    {"dwells", "attese"},          {"tool changes", "cambi utensile"}, {"spindle", "mandrino"},
    {"M functions", "funzioni M"}, {"exact stops", "arresti G09"}};
static constexpr Text kMoves{
    "blocks: {}\n"
    "rapids: {} ({:.3f} mm)\n"
    "feed moves: {} ({:.3f} mm), arcs: {} ({:.3f} mm)\n",
    "blocchi: {}\n"
    "rapidi: {} ({:.3f} mm)\n"
    "lineari: {} ({:.3f} mm), archi: {} ({:.3f} mm)\n"};
static constexpr Text kExtents{"extents (machine):", "ingombro (macchina):"};
static constexpr Text kWorkpieceExtents{"extents (workpiece frame of line {}):",
                                        "ingombro (s.d.r. di pezzo, riga {}):"};
static constexpr Text kFaceExtents{"extents (face frame of line {}):", "ingombro (s.d.r. di faccia, riga {}):"};
static constexpr Text kFramesLeftOut{"further frames: {}\n", "altri sistemi di riferimento: {}\n"};
static constexpr Text kTool{"tool {}: {}; feed moves {:.3f} mm, rapids {:.3f} mm\n",
                            "utensile {}: {}; lavoro {:.3f} mm, rapidi {:.3f} mm\n"};
static constexpr Text kNoTool{"none", "nessuno"};
static constexpr Text kBreach{"outside its travel: {} goes to {:.3f} (limit {:.3f}), first on line {}\n",
                              "fuori corsa: {} arriva a {:.3f} (limite {:.3f}), per la prima volta alla riga {}\n"};
static constexpr Text kExcesses[] = {
    {"feed above the machine's: {:.0f} mm/min (limit {:.0f}), first on line {}\n",
     "avanzamento oltre quello della macchina: {:.0f} mm/min (limite {:.0f}), per la prima volta alla riga {}\n"},
    {"B or C turn faster than the machine: {:.0f} degrees/min (limit {:.0f}), first on line {}\n",
     "B o C più veloci della macchina: {:.0f} gradi/min (limite {:.0f}), per la prima volta alla riga {}\n"},
    {"spindle speed above the machine's: {:.0f} rev/min (limit {:.0f}), first on line {}\n",
     "giri del mandrino oltre quelli della macchina: {:.0f} giri/min (limite {:.0f}), per la prima volta alla riga "
     "{}\n"}};
static constexpr Text kFinal{"final position (machine): X{:.3f} Y{:.3f} Z{:.3f} B{:.3f} C{:.3f}\n",
                             "posizione finale (macchina): X{:.3f} Y{:.3f} Z{:.3f} B{:.3f} C{:.3f}\n"};
static constexpr Text kInMillimeters{"lengths and positions: in mm, also of blocks under G70\n",
                                     "lunghezze e posizioni: in mm, anche quelle dei blocchi con la G70\n"};
static constexpr Text kFinalState{"final state: tool {}, {}\n", "stato finale: utensile {}, {}\n"};

/// The total time and its parts: `46.3 s (rapids 2.4 s, ...)`.
static std::string shown_times(double seconds, const Times& times, Language language) {
  std::string parts;
  for (std::size_t work = 0; work < times.size(); ++work)
    if (times[work] > 0)
      parts += fmt::format("{}{} {}", parts.empty() ? "" : ", ", kWorks[work].in(language), shown_time(times[work]));
  return shown_time(seconds) + (parts.empty() ? "" : " (" + parts + ")");
}

static double sum(const Times& times) {
  double seconds = 0;
  for (const double each : times) seconds += each;
  return seconds;
}

template <std::size_t Count>
static std::string shown_extents(const std::array<geometry::Range, Count>& extents) {
  std::string text;
  for (std::size_t axis = 0; axis < Count; ++axis)
    text += fmt::format("{} {} {:.3f}..{:.3f}", axis == 0 ? "" : ",", dialect::kAxisLetters[axis],
                        extents[axis].minimum, extents[axis].maximum);
  return text + '\n';
}

/// The spindle function 3, 4 or 5; 5 after a tool change, which stops the spindle.
static int spindle_function(const State& state) { return state.spindle_turns() ? state.spindle_function : 5; }

/// The state as the codes that produce it: `S12000 M03, F4000, G01 G17 ...`.
static std::string shown_state(const State& state) {
  std::string text;
  if (state.spindle_speed > 0) text += fmt::format("S{} ", state.spindle_speed);
  text += fmt::format("M{:02}, ", spindle_function(state));
  if (state.last_feed.number > 0) text += fmt::format("F{}, ", feed_in_force(state).number);
  bool is_first = true;
  for (const std::uint8_t g : state.in_force)
    if (g != dialect::kNoMotion) text += fmt::format("{}G{:02}", std::exchange(is_first, false) ? "" : " ", g);
  return text;
}

std::string Summary::text(Language language) const {
  const auto& [rapids, feeds, arcs] = moves_;
  const auto say = [&](const Text& text, const auto&... values) { return dialect::format(text, language, values...); };
  const auto name_of = [&](const std::optional<execution::ToolCode>& tool) {
    return tool ? running::tool_name(*tool) : std::string(kNoTool.in(language));
  };
  std::string said = say(kResult, kEndings[static_cast<std::size_t>(result_.ending)].in(language), result_.line + 1);
  if (result_.jumped_over_from) said += say(kJumpedOverLine, *result_.jumped_over_from + 1);
  said.append("\n").append(kCycleTime.in(language)).append(shown_times(seconds_, times_, language)).append("\n");
  said += say(kMoves, result_.blocks, rapids.count, rapids.mm, feeds.count, feeds.mm, arcs.count, arcs.mm);
  if (extents_) said.append(kExtents.in(language)).append(shown_extents(*extents_));
  for (const FrameExtents& each : frames_.frames())
    said += say(each.is_face ? kFaceExtents : kWorkpieceExtents, each.line + 1) + shown_extents(each.extents);
  if (frames_.left_out() > 0) said += say(kFramesLeftOut, frames_.left_out());
  for (const ToolShare& share : tools_)
    said += say(kTool, name_of(share.tool), shown_times(sum(share.times), share.times, language), share.feed_mm,
                share.rapid_mm);
  for (std::size_t i = 0; i < breaches_.size(); ++i)
    if (const auto& breach = breaches_[i])
      said += say(kBreach, dialect::kAxisLetters[i / 2], breach->farthest, breach->limit, breach->line + 1);
  for (std::size_t i = 0; i < excesses_.size(); ++i)
    if (const auto& excess = excesses_[i])
      said +=
          say(kExcesses[i], excess->maximum, limit_of(static_cast<simulation::Limit>(i), machine_), excess->line + 1);
  const geometry::Pose pose = final_pose();
  if (has_inches_) said += kInMillimeters.in(language);
  said += say(kFinal, pose.tip.x(), pose.tip.y(), pose.tip.z(), pose.b, pose.c);
  const State& state = result_.state;
  const auto tool = state.tool_selected ? std::optional(state.tool) : std::nullopt;
  return said + say(kFinalState, name_of(tool), shown_state(state));
}

static constexpr std::string_view kWorkKeys[] = {"rapids",      "feeds",   "arcs",      "dwells",
                                                 "toolChanges", "spindle", "functions", "exactStops"};

static OrderedJson json_of(const Times& times) {
  OrderedJson json;
  for (std::size_t work = 0; work < times.size(); ++work) json[std::string(kWorkKeys[work])] = times[work];
  return json;
}

template <std::size_t Count>
static OrderedJson json_of(const std::array<geometry::Range, Count>& extents) {
  OrderedJson json;
  for (std::size_t axis = 0; axis < Count; ++axis)
    json[std::string(1, dialect::kAxisLetters[axis])] = {extents[axis].minimum, extents[axis].maximum};
  return json;
}

static OrderedJson json_of(const geometry::Vec3& vector) {
  return OrderedJson::array({vector.x(), vector.y(), vector.z()});
}

static OrderedJson json_of(const FrameExtents& each) {
  return {{"line", each.line + 1},
          {"kind", each.is_face ? "face" : "workpiece"},
          {"origin", json_of(each.frame.origin)},
          {"i", json_of(geometry::Vec3(each.frame.axes.col(0)))},
          {"j", json_of(geometry::Vec3(each.frame.axes.col(1)))},
          {"k", json_of(geometry::Vec3(each.frame.axes.col(2)))},
          {"extents", json_of(each.extents)}};
}

static OrderedJson error_of(const running::RunResult& result, Language language) {
  if (result.ending != running::Ending::Error) return nullptr;
  const dialect::DiagnosticDef& def = dialect::definition(result.error.id);
  return {{"line", result.line + 1},
          {"code", def.code},
          {"name", def.name},
          {"message", running::error_message(result, language)}};
}

static OrderedJson json_of(const simulation::RunWarning& warning, Language language) {
  const dialect::DiagnosticDef& def = dialect::definition(warning.id);
  return {{"line", warning.line + 1},
          {"code", def.code},
          {"name", def.name},
          {"message", syntax::message(finding_of(warning), {}, language)}};
}

static OrderedJson json_of(const State& state) {
  OrderedJson modes = OrderedJson::array();
  for (const std::uint8_t g : state.in_force)
    if (g != dialect::kNoMotion) modes.push_back(fmt::format("G{:02}", g));
  return {{"tool", state.tool_selected ? OrderedJson(running::tool_name(state.tool)) : OrderedJson()},
          {"spindle", {{"speed", state.spindle_speed}, {"m", spindle_function(state)}}},
          {"feed", state.last_feed.number > 0 ? OrderedJson(feed_in_force(state).number) : OrderedJson()},
          {"modes", modes}};
}

std::string Summary::json(std::string_view file, Language language) const {
  static constexpr std::string_view kResults[] = {"end", "error", "until"};
  static constexpr std::string_view kLimits[] = {"feed", "rotarySpeed", "spindleSpeed"};
  OrderedJson json = {
      {"file", file},
      {"result", kResults[static_cast<std::size_t>(result_.ending)]},
      {"line", result_.line + 1},
      {"jumpedOverFrom", result_.jumped_over_from ? OrderedJson(*result_.jumped_over_from + 1) : OrderedJson()},
      {"error", error_of(result_, language)},
      {"seconds", seconds_},
      {"times", json_of(times_)},
      {"blocks", result_.blocks}};
  for (std::size_t kind = 0; kind < moves_.size(); ++kind)
    json[std::string(kWorkKeys[kind])] = {
        {"count", moves_[kind].count}, {"lengthMm", moves_[kind].mm}, {"seconds", times_[kind]}};
  json["extents"] = extents_ ? json_of(*extents_) : OrderedJson();
  json["frames"] = OrderedJson::array();
  for (const FrameExtents& each : frames_.frames()) json["frames"].push_back(json_of(each));
  json["framesLeftOut"] = frames_.left_out();
  json["tools"] = OrderedJson::array();
  for (const ToolShare& share : tools_)
    json["tools"].push_back({{"tool", share.tool ? OrderedJson(running::tool_name(*share.tool)) : OrderedJson()},
                             {"seconds", sum(share.times)},
                             {"times", json_of(share.times)},
                             {"feedMm", share.feed_mm},
                             {"rapidMm", share.rapid_mm}});
  json["outsideTravel"] = OrderedJson::array();
  for (std::size_t i = 0; i < breaches_.size(); ++i)
    if (const auto& breach = breaches_[i])
      json["outsideTravel"].push_back({{"axis", std::string(1, dialect::kAxisLetters[i / 2])},
                                       {"line", breach->line + 1},
                                       {"farthest", breach->farthest},
                                       {"limit", breach->limit}});
  json["aboveLimits"] = OrderedJson::array();
  for (std::size_t i = 0; i < excesses_.size(); ++i)
    if (const auto& excess = excesses_[i])
      json["aboveLimits"].push_back({{"limit", kLimits[i]},
                                     {"line", excess->line + 1},
                                     {"most", excess->maximum},
                                     {"allowed", limit_of(static_cast<simulation::Limit>(i), machine_)}});
  json["warnings"] = OrderedJson::array();
  for (const simulation::RunWarning& warning : warnings_) json["warnings"].push_back(json_of(warning, language));
  const geometry::Pose pose = final_pose();
  json["final"] = {pose.tip.x(), pose.tip.y(), pose.tip.z(), pose.b, pose.c};
  json["finalJoints"] = {joints_[0], joints_[1], joints_[2], joints_[3], joints_[4]};
  json["finalState"] = json_of(result_.state);
  return json.dump(-1, ' ', false, OrderedJson::error_handler_t::replace) + '\n';
}

}  // namespace isocnc::summary
