#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "interpreter/dialect/format.h"
#include "interpreter/text/characters.h"
#include "lsp/features/feature.h"
#include "lsp/queries/names.h"
#include "lsp/queries/text_edits.h"

/// Renames a label and its GOTOs, or a register, if that keeps the program's behavior.
namespace isocnc::features {

using dialect::Text;
using queries::Name;
using queries::NameKind;
using queries::Occurrence;

/// The number of digits that a double holds without loss.
static constexpr std::size_t kMaxDigits = 15;

namespace {

struct RenameParams : protocol::PositionParams {
  std::string new_name;
};

void from_json(const Json& json, RenameParams& params) {
  from_json(json, static_cast<protocol::PositionParams&>(params));
  params.new_name = json.at("newName");
}

struct Prepared {
  ClientRange range;
  std::string placeholder;
};

void to_json(Json& json, const Prepared& prepared) {
  json = {{"range", prepared.range}, {"placeholder", prepared.placeholder}};
}

char letter_of(NameKind kind) { return kind == NameKind::Label ? 'N' : 'V'; }
std::string text_of(const Name& name) { return fmt::format("{}{}", letter_of(name.kind), name.number); }

template <class... Arguments>
[[noreturn]] void refuse(const Snapshot& snapshot, const Text& message, const Arguments&... arguments) {
  throw rpc::Error(rpc::ErrorCode::RequestFailed, dialect::format(message, snapshot.language(), arguments...));
}

Occurrence renamed_at(const Snapshot& snapshot, const ClientPosition& position) {
  if (const auto name = queries::name_at(snapshot, snapshot.from_client(position))) return *name;
  refuse(snapshot, {"only line numbers and registers can be renamed", "si rinominano solo numeri di linea e registri"});
}

/// Reads `N30`, `n30` or `30`; nothing if such a name cannot have that number.
std::optional<Name> read_name(std::string_view text, NameKind kind) {
  const auto is_blank_at = [&](std::size_t at) { return text::is_blank(text[at]); };
  while (!text.empty() && is_blank_at(0)) text.remove_prefix(1);
  while (!text.empty() && is_blank_at(text.size() - 1)) text.remove_suffix(1);
  if (!text.empty() && text::upper(text[0]) == letter_of(kind)) text.remove_prefix(1);
  if (text.empty() || text.size() > kMaxDigits) return std::nullopt;
  std::uint64_t number = 0;
  for (const char digit : text) {
    if (!text::is_digit(digit)) return std::nullopt;
    number = number * 10 + static_cast<std::uint64_t>(digit - '0');
  }
  if (kind == NameKind::Register && !dialect::is_register(static_cast<double>(number))) return std::nullopt;
  return Name{kind, number};
}

/// Throws if the name is already used: two merged names could no longer be distinguished.
void require_free(const Snapshot& snapshot, const Name& name) {
  const std::vector<Occurrence> taken = queries::occurrences(snapshot, name);
  if (taken.empty()) return;
  refuse(snapshot, {"{} is taken: it stands in line {}", "{} è già usato alla linea {}"}, text_of(name),
         taken.front().line + 1);
}

/// All places to rename. A line number that no GOTO names is renamed on its own line only.
std::vector<Occurrence> meant_with(const Snapshot& snapshot, const Occurrence& chosen) {
  std::vector<Occurrence> all = queries::occurrences(snapshot, chosen.name);
  for (const Occurrence& each : all)
    if (chosen.name.kind == NameKind::Register || !each.is_definition) return all;
  return {chosen};
}

/// Replaces only the digits: letter, blanks and comments stay.
void write(const Snapshot& snapshot, const Occurrence& place, const std::string& digits,
           std::vector<protocol::TextEdit>& edits) {
  const syntax::DocumentLine read = snapshot.document().line(place.line);
  const syntax::LineTree& line = *read;
  bool is_first = true;
  for (const syntax::Span piece : queries::outside_comments(line, {place.span.begin + 1, place.span.end}))
    edits.push_back({snapshot.to_client(place.line, piece), std::exchange(is_first, false) ? digits : ""});
}

Json rename_at(const Snapshot& snapshot, const RenameParams& params) {
  const Occurrence chosen = renamed_at(snapshot, params.position);
  const auto name = read_name(params.new_name, chosen.name.kind);
  if (!name && chosen.name.kind == NameKind::Register)
    refuse(snapshot, {"registers are V1 to V30", "i registri vanno da V1 a V30"});
  if (!name)
    refuse(snapshot, {"a line number is N with 1 to {} digits", "un numero di linea è N seguita da 1 a {} cifre"},
           kMaxDigits);
  std::vector<protocol::TextEdit> edits;
  if (*name == chosen.name) return queries::workspace_edit(snapshot, edits);
  require_free(snapshot, *name);
  for (const Occurrence& each : meant_with(snapshot, chosen))
    write(snapshot, each, fmt::to_string(name->number), edits);
  return queries::workspace_edit(snapshot, edits);
}

std::optional<Prepared> prepare(const Snapshot& snapshot, const protocol::PositionParams& params) {
  const auto name = queries::name_at(snapshot, snapshot.from_client(params.position));
  if (!name) return std::nullopt;
  return Prepared{snapshot.to_client(name->line, name->span), text_of(name->name)};
}

Json rename_capabilities(const Client& client) {
  if (!client.can("/textDocument/rename/prepareSupport")) return {{"renameProvider", true}};
  return {{"renameProvider", {{"prepareProvider", true}}}};
}

}  // namespace

extern const Feature rename = {
    .capabilities = rename_capabilities,
    .methods = {on<&rename_at>("textDocument/rename"), on<&prepare>("textDocument/prepareRename")}};

}  // namespace isocnc::features
