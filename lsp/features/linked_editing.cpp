#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "lsp/features/feature.h"
#include "lsp/queries/names.h"

/// Linked editing: the number of a label or register changes in all its places while it is typed.
namespace isocnc::features {
namespace {

struct LinkedRanges {
  std::vector<ClientRange> ranges;
};

void to_json(Json& json, const LinkedRanges& linked) { json = {{"ranges", linked.ranges}, {"wordPattern", "[0-9]+"}}; }

/// Nothing if the places are written differently (N7 and N007): the editor could not keep them equal.
std::optional<LinkedRanges> answer_linked_editing(const Snapshot& snapshot, const protocol::PositionParams& params) {
  const auto name = queries::name_at(snapshot, snapshot.from_client(params.position));
  if (!name) return std::nullopt;
  LinkedRanges linked;
  bool has_reference = false;
  std::string_view text;
  for (const queries::Occurrence& each : queries::occurrences(snapshot, name->name)) {
    const syntax::DocumentLine read = snapshot.document().line(each.line);
    const syntax::LineTree& line = *read;
    const auto pieces = queries::outside_comments(line, {each.span.begin + 1, each.span.end});
    if (pieces.size() != 1) return std::nullopt;
    const std::string_view number = line.text_of(pieces[0]);
    if (number.find_first_not_of("0123456789") != std::string_view::npos) return std::nullopt;
    if (!text.empty() && number != text) return std::nullopt;
    text = number;
    has_reference |= !each.is_definition || name->name.kind == queries::NameKind::Register;
    linked.ranges.push_back(snapshot.to_client(each.line, pieces[0]));
  }
  return has_reference && linked.ranges.size() > 1 ? std::optional(std::move(linked)) : std::nullopt;
}

Json linked_editing_capabilities(const Client&) { return {{"linkedEditingRangeProvider", true}}; }

}  // namespace

extern const Feature linked_editing = {.capabilities = linked_editing_capabilities,
                                       .methods = {on<&answer_linked_editing>("textDocument/linkedEditingRange")}};

}  // namespace isocnc::features
