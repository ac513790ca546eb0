#include "interpreter/running/summary.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "interpreter/motion/travel.h"

namespace isocnc::running {

using dialect::Language;
using dialect::Text;
using execution::MoveKind;
using Json = nlohmann::ordered_json;

static constexpr std::string_view kAxes = "XYZBC";

Summary::Summary(const TimedMachine& machine)
    : machine_(machine),
      checks_travel_(std::any_of(machine.motion.axes.begin(), machine.motion.axes.end(), [](const auto& axis) {
        return std::isfinite(axis.least) || std::isfinite(axis.most);
      })) {}

/// The share of the tool that is mounted; before the first M06 of none.
ToolShare& Summary::share() {
  if (share_ == kNoShare) mount(std::nullopt);
  return tools_[share_];
}

void Summary::mount(std::optional<execution::ToolCode> tool) {
  const auto known =
      std::find_if(tools_.begin(), tools_.end(), [&](const ToolShare& share) { return share.tool == tool; });
  share_ = static_cast<std::size_t>(known - tools_.begin());
  if (known == tools_.end()) tools_.push_back({.tool = tool});
}

void Summary::add(const TimedEvent& timed) {
  if (const auto* const tool = std::get_if<ToolEvent>(&timed.event.what)) mount(tool->tool);
  if (timed.duration > 0) share().seconds += timed.duration;
  if (const auto* const move = std::get_if<MoveEvent>(&timed.event.what)) add_move(*move, timed.duration);
}

void Summary::add(const motion::Move& move, std::uint64_t line) {
  if (!checks_travel_) return;
  for (const motion::Overtravel& found : motion::overtravels(machine_.motion, move)) {
    const std::size_t side = found.position > found.limit ? 1 : 0;
    std::optional<TravelBreach>& breach = breaches_[2 * static_cast<std::size_t>(found.axis) + side];
    if (!breach) breach = TravelBreach{.line = line, .farthest = found.position, .limit = found.limit};
    if (std::abs(found.position - found.limit) > std::abs(breach->farthest - breach->limit))
      breach->farthest = found.position;
  }
}

void Summary::add_move(const MoveEvent& move, double seconds) {
  Travelled& travelled = moves_[static_cast<std::size_t>(move.kind)];
  ++travelled.count;
  travelled.mm += move.length;
  travelled.seconds += seconds;
  (move.kind == MoveKind::Rapid ? share().rapid_mm : share().feed_mm) += move.length;
  const auto reached = execution::extents(move);
  if (!extents_) {
    extents_ = reached;
    return;
  }
  for (std::size_t axis = 0; axis < reached.size(); ++axis) {
    geometry::Range& all = (*extents_)[axis];
    all = {std::min(all.least, reached[axis].least), std::max(all.most, reached[axis].most)};
  }
}

void Summary::finish(const RunResult& result, double seconds) {
  result_ = result;
  seconds_ = seconds;
}

/// `1 h 02 min 03.4 s`, `2 min 03.4 s`, `3.4 s`: the same in both languages.
static std::string shown_time(double seconds) {
  const double tenths = std::round(seconds * 10);
  const double minutes = std::floor(tenths / 600);
  const double hours = std::floor(minutes / 60);
  const double rest = (tenths - minutes * 600) / 10;
  if (hours > 0) return fmt::format("{:.0f} h {:02.0f} min {:04.1f} s", hours, minutes - hours * 60, rest);
  if (minutes > 0) return fmt::format("{:.0f} min {:04.1f} s", minutes, rest);
  return fmt::format("{:.1f} s", rest);
}

static std::string shown_tool(const execution::ToolCode& tool) {
  return fmt::format("T{}{:02}{:03}", tool.head, tool.holder, tool.tool);
}

static constexpr Text kEndings[] = {{"ran to M02", "eseguito fino a M02"},
                                    {"stopped by an error", "fermato da un errore"},
                                    {"stopped where asked", "fermato dove richiesto"}};
static constexpr Text kSummary{
    "result: {}, line {}\n"
    "cycle time: {} (cutting {}, rapids {}, waiting {})\n"
    "blocks: {}\n"
    "rapids: {} ({:.3f} mm)\n"
    "feed moves: {}, arcs: {} ({:.3f} mm)\n",
    "esito: {}, riga {}\n"
    "tempo ciclo: {} (lavoro {}, rapidi {}, attese {})\n"
    "blocchi: {}\n"
    "rapidi: {} ({:.3f} mm)\n"
    "lineari: {}, archi: {} ({:.3f} mm)\n"};
static constexpr Text kExtents{"extents (machine):", "ingombro (macchina):"};
static constexpr Text kTool{"tool {}: {}, feed moves {:.3f} mm, rapids {:.3f} mm\n",
                            "utensile {}: {}, lavoro {:.3f} mm, rapidi {:.3f} mm\n"};
static constexpr Text kNoTool{"none", "nessuno"};
static constexpr Text kBreach{"outside its travel: {} goes to {:.3f} (limit {:.3f}), first on line {}\n",
                              "fuori corsa: {} arriva a {:.3f} (limite {:.3f}), per la prima volta alla riga {}\n"};
static constexpr Text kFinal{"final position (machine): X{:.3f} Y{:.3f} Z{:.3f} B{:.3f} C{:.3f}\n",
                             "posizione finale (macchina): X{:.3f} Y{:.3f} Z{:.3f} B{:.3f} C{:.3f}\n"};

std::string Summary::text(Language language) const {
  const auto& [rapids, feeds, arcs] = moves_;
  const double cutting = feeds.seconds + arcs.seconds;
  const auto in = [&](const Text& text) { return fmt::runtime(text.in(language)); };
  std::string said =
      fmt::format(in(kSummary), kEndings[static_cast<std::size_t>(result_.ending)].in(language), result_.line + 1,
                  shown_time(seconds_), shown_time(cutting), shown_time(rapids.seconds),
                  shown_time(std::max(0.0, seconds_ - cutting - rapids.seconds)), result_.blocks, rapids.count,
                  rapids.mm, feeds.count, arcs.count, feeds.mm + arcs.mm);
  if (extents_) {
    said += kExtents.in(language);
    for (std::size_t axis = 0; axis < extents_->size(); ++axis)
      said += fmt::format("{} {} {:.3f}..{:.3f}", axis == 0 ? "" : ",", kAxes[axis], (*extents_)[axis].least,
                          (*extents_)[axis].most);
    said += '\n';
  }
  for (const ToolShare& share : tools_)
    said += fmt::format(in(kTool), share.tool ? shown_tool(*share.tool) : std::string(kNoTool.in(language)),
                        shown_time(share.seconds), share.feed_mm, share.rapid_mm);
  for (std::size_t i = 0; i < breaches_.size(); ++i)
    if (const auto& breach = breaches_[i])
      said += fmt::format(in(kBreach), kAxes[i / 2], breach->farthest, breach->limit, breach->line + 1);
  const execution::State& state = result_.state;
  const geometry::Vec3 tip = state.to_machine(state.position.tip);
  return said + fmt::format(in(kFinal), tip.x(), tip.y(), tip.z(), state.position.b, state.position.c);
}

static Json error_of(const RunResult& result, Language language) {
  if (result.ending != Ending::Error) return nullptr;
  const syntax::Span span = result.error.span;
  const std::string_view marked = result.line_text.substr(span.begin, span.end - span.begin);
  const dialect::DiagnosticDef& def = dialect::definition(result.error.id);
  return {{"line", result.line + 1},
          {"code", def.code},
          {"name", def.name},
          {"message", dialect::message(result.error.id, language, marked, result.error.values)}};
}

std::string Summary::json(std::string_view file, Language language) const {
  static constexpr std::string_view kResults[] = {"end", "error", "until"};
  static constexpr std::string_view kKinds[] = {"rapids", "feeds", "arcs"};
  Json json = {{"file", file},
               {"result", kResults[static_cast<std::size_t>(result_.ending)]},
               {"line", result_.line + 1},
               {"error", error_of(result_, language)},
               {"seconds", seconds_},
               {"blocks", result_.blocks}};
  for (std::size_t kind = 0; kind < moves_.size(); ++kind)
    json[std::string(kKinds[kind])] = {
        {"count", moves_[kind].count}, {"lengthMm", moves_[kind].mm}, {"seconds", moves_[kind].seconds}};
  json["extents"] = nullptr;
  for (std::size_t axis = 0; extents_ && axis < extents_->size(); ++axis)
    json["extents"][std::string(1, kAxes[axis])] = {(*extents_)[axis].least, (*extents_)[axis].most};
  json["tools"] = Json::array();
  for (const ToolShare& share : tools_)
    json["tools"].push_back({{"tool", share.tool ? Json(shown_tool(*share.tool)) : Json()},
                             {"seconds", share.seconds},
                             {"feedMm", share.feed_mm},
                             {"rapidMm", share.rapid_mm}});
  json["outsideTravel"] = Json::array();
  for (std::size_t i = 0; i < breaches_.size(); ++i)
    if (const auto& breach = breaches_[i])
      json["outsideTravel"].push_back({{"axis", std::string(1, kAxes[i / 2])},
                                       {"line", breach->line + 1},
                                       {"farthest", breach->farthest},
                                       {"limit", breach->limit}});
  const execution::State& state = result_.state;
  const geometry::Vec3 tip = state.to_machine(state.position.tip);
  json["final"] = {tip.x(), tip.y(), tip.z(), state.position.b, state.position.c};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace isocnc::running
