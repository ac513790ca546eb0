#include "debugger/session/locations.h"

#include <algorithm>
#include <filesystem>
#include <limits>

#include "interpreter/syntax/tree_store.h"
#include "interpreter/text/unicode.h"

namespace isocnc::session {

using debuggee::Journal;
using expressions::Quantity;

static constexpr dialect::Text kNowhere{"no place has the reference {}", "nessun punto ha il riferimento {}"};

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
  const auto number = expressions::find_register(quantity.name);
  return number ? std::optional(Journal::Values::kRegisters + static_cast<std::size_t>(*number)) : std::nullopt;
}

/// What has been changed by hand has another value than the program has set.
static std::optional<std::size_t> setting_line(const Session& session, const Quantity& quantity) {
  const simulation::Simulation& present = session.debuggee().present();
  if (const auto group = mode_of(quantity)) {
    const auto setting = session.journal().setting(*group, present.blocks());
    if (setting && setting->number == present.run().state.mode(*group)) return setting->line;
  } else if (const auto value = value_of(quantity)) {
    const auto setting = session.journal().value_setting(*value, present.blocks());
    if (setting && setting->number == Journal::Values(present.run()).numbers[*value]) return setting->line;
  }
  return std::nullopt;
}

std::int64_t location_of(const Session& session, const Quantity& quantity) {
  const auto line = setting_line(session, quantity);
  return line ? reference_to(*line, &quantity - expressions::all_quantities().data()) : 0;
}

std::int64_t location_of_neighbor(std::size_t place) { return reference_to(place, kNeighbor); }

static SettingWord word_of(const Session& session, const Quantity& quantity) {
  if (const auto group = mode_of(quantity)) return {'G', session.debuggee().present().run().state.mode(*group)};
  if (const auto number = expressions::find_register(quantity.name)) return {'V', *number};
  return {quantity.name.front(), std::nullopt};
}

/// The word on the line, or the whole line where it stands otherwise.
static Json program_location(const Session& session, std::size_t line, const Quantity& quantity) {
  const std::string_view text = session.debuggee().text().line(line);
  const dap::ClientProfile& client = session.client();
  Json json = {{"source", session.source()}, {"line", client.to_client_line(line)}};
  const SettingWord wanted = word_of(session, quantity);
  const syntax::ParsedLine parsed(text);
  for (const syntax::Word& word : parsed.tree().words) {
    if (word.letter != wanted.letter || (wanted.number && word.whole() != wanted.number)) continue;
    json["column"] = client.to_client_column(text::column_of(text, word.begin) - 1);
    json["endLine"] = json["line"];
    json["endColumn"] = client.to_client_column(text::column_of(text, word.end) - 1);
    break;
  }
  return json;
}

static Json file_location(const Session& session, const dialect::FilePlace& place) {
  const std::filesystem::path file = std::filesystem::absolute(place.file);
  return {{"source", {{"name", file.filename().generic_string()}, {"path", file.generic_string()}}},
          {"line", session.client().to_client_line(place.line)}};
}

Json location(const Session& session, std::int64_t reference) {
  const debuggee::Debuggee& debuggee = session.stopped_debuggee();
  const std::int64_t kind = (reference - 1) % kKinds;
  if (reference > 0) {
    const auto place = static_cast<std::size_t>((reference - 1) / kKinds);
    const auto quantities = expressions::all_quantities();
    if (kind < static_cast<std::int64_t>(quantities.size()) && place < debuggee.text().line_count())
      return program_location(session, place, quantities[static_cast<std::size_t>(kind)]);
    const auto& neighbors = session.surroundings().neighbors_of(debuggee.present());
    if (kind == kNeighbor && place < neighbors.size() && !neighbors[place].described.file.empty())
      return file_location(session, neighbors[place].described);
  }
  throw dap::RequestError(session.in_language(kNowhere, reference));
}

}  // namespace isocnc::session
