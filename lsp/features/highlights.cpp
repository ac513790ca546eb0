#include <optional>
#include <vector>

#include "lsp/features/feature.h"
#include "lsp/queries/names.h"

/// Highlights all occurrences of the label or register under the cursor.
namespace isocnc::features {
namespace {

struct Highlight {
  ClientRange range;
  bool writes = false;
};

void to_json(Json& json, const Highlight& highlight) {
  json = {{"range", highlight.range}, {"kind", highlight.writes ? 3 : 2}};
}

std::optional<std::vector<Highlight>> answer_highlights(const Snapshot& snapshot,
                                                        const protocol::PositionParams& params) {
  const auto name = queries::name_at(snapshot, snapshot.from_client(params.position));
  if (!name) return std::nullopt;
  std::vector<Highlight> highlights;
  for (const queries::Occurrence& each : queries::occurrences(snapshot, name->name))
    highlights.push_back({snapshot.to_client(each.line, each.span), each.is_definition});
  return highlights;
}

Json highlights_capabilities(const Client&) { return {{"documentHighlightProvider", true}}; }

}  // namespace

extern const Feature highlights = {.capabilities = highlights_capabilities,
                                   .methods = {on<&answer_highlights>("textDocument/documentHighlight")}};

}  // namespace isocnc::features
