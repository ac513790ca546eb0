#include "debugger/session/watchmen.h"

#include <algorithm>

#include "analyzer/explain.h"
#include "debugger/session/block_effect.h"
#include "debugger/session/expression.h"
#include "interpreter/dialect/format.h"
#include "interpreter/motion/travel.h"

namespace isocnc::debugger::session {

using dialect::Language;
using dialect::Text;

static constexpr std::array<WatchDef, kWatchCount> kWatches{{
    {"errors",
     {"Program errors", "Errori di programma"},
     {"Where the control would stop with an error", "Dove il controllo si fermerebbe con un errore"},
     true},
    {"warnings",
     {"Warnings", "Avvisi"},
     {"Before blocks of which isolint warns", "Prima dei blocchi per cui isolint avvisa"}},
    {"limits",
     {"Axis limits", "Limiti degli assi"},
     {"Before motions that take an axis beyond its travel", "Prima dei movimenti che portano un asse oltre la corsa"}},
    {"toolChange", {"Tool changes", "Cambi utensile"}, {"Before each M06", "Prima di ogni M06"}},
    {"firstCut",
     {"First cut", "Primo taglio"},
     {"Before the first feed move of each tool", "Prima del primo movimento in lavoro di ogni utensile"}},
}};

const WatchDef& definition(Watch watch) { return kWatches[static_cast<std::size_t>(watch)]; }

std::optional<Watch> find_watch(std::string_view name) {
  for (std::size_t i = 0; i < kWatches.size(); ++i)
    if (kWatches[i].name == name) return static_cast<Watch>(i);
  return std::nullopt;
}

bool Watchmen::looks_at_blocks() const {
  return is_on(Watch::Limits) || is_on(Watch::ToolChange) || is_on(Watch::FirstCut) ||
         (is_on(Watch::Warnings) && !warnings.empty());
}

namespace {

constexpr Text kBeyondTravel{"axis {} would go to {}, beyond its travel, which ends at {}",
                             "l'asse {} andrebbe a {}, oltre la corsa, che finisce a {}"};
constexpr Text kAnyToolChange{"tool change", "cambio utensile"};
constexpr Text kFirstCut{"first feed move of this tool", "primo movimento in lavoro di questo utensile"};

std::optional<Exception> find_overtravel(const std::vector<execution::MachineMove>& moves, double tool_length,
                                         const simulation::TimedMachine& machine, Language language) {
  for (const execution::MachineMove& move : moves)
    for (const motion::Overtravel& found :
         motion::overtravels(machine.motion, simulation::planned_move(move, machine, tool_length))) {
      const std::string text = dialect::format(kBeyondTravel, language, dialect::kAxisLetters[found.axis],
                                               show_value(found.position), show_value(found.limit));
      return Exception{Watch::Limits, std::string(definition(Watch::Limits).name), text, {}};
    }
  return std::nullopt;
}

}  // namespace

std::optional<Exception> Watchmen::look_at_warnings(const running::Block& block, Language language) const {
  const auto warning = warnings.find(block.line);
  if (warning == warnings.end()) return std::nullopt;
  return Exception{Watch::Warnings, std::string(dialect::definition(warning->second.id).code), warning->second.message,
                   analyzer::explain(warning->second.id, language)};
}

std::optional<Exception> Watchmen::look_at(const running::Block& block, const execution::Setup& setup,
                                           const simulation::TimedMachine& machine, Language language) const {
  if (is_on(Watch::Warnings))
    if (auto warned = look_at_warnings(block, language)) return warned;
  const auto plainly = [&](Watch watch, const Text& text) {
    return Exception{watch, std::string(definition(watch).name), std::string(text.in(language)), {}};
  };
  if (is_on(Watch::ToolChange) && changes_tool(block)) return plainly(Watch::ToolChange, kAnyToolChange);
  if (!is_on(Watch::Limits) && !is_on(Watch::FirstCut)) return std::nullopt;
  const BlockEffect effect = effect_of(block, setup);
  if (effect.has_error) return std::nullopt;
  const bool cuts = std::any_of(effect.moves.begin(), effect.moves.end(),
                                [](const auto& move) { return move.kind != execution::MoveKind::Rapid; });
  if (is_on(Watch::FirstCut) && cuts && block.state.knows(execution::State::kUncut))
    return plainly(Watch::FirstCut, kFirstCut);
  if (is_on(Watch::Limits))
    return find_overtravel(effect.moves, machine.tool_length(block.state.tool), machine, language);
  return std::nullopt;
}

}  // namespace isocnc::debugger::session
