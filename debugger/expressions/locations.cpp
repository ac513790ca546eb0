#include "debugger/expressions/locations.h"

#include <algorithm>
#include <limits>

#include "interpreter/syntax/tree_store.h"

namespace isocnc::expressions {

using debuggee::Journal;

/// A reference holds a line of the program and the place of a quantity among all, or an obstacle in place of the line.
static constexpr std::int64_t kKinds = 128;
static constexpr std::int64_t kNeighbor = kKinds - 1;

static std::int64_t reference_to(std::size_t line, std::int64_t kind) {
  constexpr std::int64_t kMaxReference = std::numeric_limits<std::int32_t>::max();  // As the protocol says.
  if (line >= static_cast<std::size_t>(kMaxReference / kKinds)) return 0;
  return static_cast<std::int64_t>(line) * kKinds + kind + 1;
}

namespace {

/// A word of a line that sets something.
struct SettingWord {
  char letter = 0;
  std::optional<int> number;  ///< Any for none.
};

}  // namespace

/// The modal group whose G a quantity is.
static std::optional<dialect::ModalGroup> mode_of(const Quantity& quantity) {
  for (std::size_t i = 0; i < dialect::kModalGroupCount; ++i)
    if (dialect::kModalGroups[i].variable == quantity.name) return static_cast<dialect::ModalGroup>(i);
  return std::nullopt;
}

/// Which of the journal's values a quantity is.
static std::optional<std::size_t> value_of(const Quantity& quantity) {
  if (quantity.name == "F") return Journal::Values::kFeed;
  if (quantity.name == "S") return Journal::Values::kSpindleSpeed;
  if (quantity.name == "T") return Journal::Values::kTool;
  const auto number = find_register(quantity.name);
  return number ? std::optional(Journal::Values::kRegisters + static_cast<std::size_t>(*number)) : std::nullopt;
}

/// What has been changed by hand has another value than the program has set.
static std::optional<std::size_t> setting_line(const Quantity& quantity, const Journal& journal,
                                               const simulation::Simulation& present) {
  if (const auto group = mode_of(quantity)) {
    const auto setting = journal.setting(*group, present.blocks());
    if (setting && setting->number == present.run().state.mode(*group)) return setting->line;
  } else if (const auto value = value_of(quantity)) {
    const auto setting = journal.value_setting(*value, present.blocks());
    if (setting && setting->number == Journal::Values(present.run()).numbers[*value]) return setting->line;
  }
  return std::nullopt;
}

std::int64_t location_of(const Quantity& quantity, const Journal& journal, const simulation::Simulation& present) {
  const auto line = setting_line(quantity, journal, present);
  return line ? reference_to(*line, &quantity - all_quantities().data()) : 0;
}

std::int64_t location_of_neighbor(std::size_t place) { return reference_to(place, kNeighbor); }

static SettingWord word_of(const Quantity& quantity, const execution::State& state) {
  if (const auto group = mode_of(quantity)) return {'G', state.mode(*group)};
  if (const auto number = find_register(quantity.name)) return {'V', *number};
  return {quantity.name.front(), std::nullopt};
}

static std::optional<syntax::Span> find_word(std::string_view line, const SettingWord& wanted) {
  const syntax::ParsedLine parsed(line);
  for (const syntax::Word& word : parsed.tree().words)
    if (word.letter == wanted.letter && (!wanted.number || word.whole() == wanted.number)) return word.span();
  return std::nullopt;
}

std::optional<LinkedPlace> find_location(std::int64_t reference, const debuggee::Debuggee& debuggee,
                                         const debuggee::Surroundings& surroundings) {
  if (reference <= 0) return std::nullopt;
  const std::int64_t kind = (reference - 1) % kKinds;
  const auto place = static_cast<std::size_t>((reference - 1) / kKinds);
  const auto quantities = all_quantities();
  if (kind < static_cast<std::int64_t>(quantities.size()) && place < debuggee.text().line_count()) {
    const SettingWord word = word_of(quantities[static_cast<std::size_t>(kind)], debuggee.present().run().state);
    return LinkedPlace{.line = place, .word = find_word(debuggee.text().line(place), word), .other_file = {}};
  }
  if (kind != kNeighbor) return std::nullopt;
  const auto& neighbors = surroundings.neighbors_of(debuggee.present());
  if (place >= neighbors.size() || neighbors[place].described.file.empty()) return std::nullopt;
  return LinkedPlace{.word = {}, .other_file = neighbors[place].described};
}

}  // namespace isocnc::expressions
