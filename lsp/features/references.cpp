#include <optional>
#include <vector>

#include "lsp/documents/names.h"
#include "lsp/features/feature.h"

/// Lists the places where a label or a register is written.
namespace isocnc::lsp::features {
namespace {

struct ReferenceParams : documents::PositionParams {
  bool wants_definitions = false;
};

void from_json(const Json& json, ReferenceParams& params) {
  from_json(json, static_cast<documents::PositionParams&>(params));
  if (const auto context = documents::member<Json>(json, "context"))
    params.wants_definitions = documents::member<bool>(*context, "includeDeclaration").value_or(false);
}

std::optional<std::vector<documents::Location>> answer_references(const Snapshot& snapshot,
                                                                  const ReferenceParams& params) {
  const auto name = documents::name_at(snapshot, snapshot.from_client(params.position));
  if (!name) return std::nullopt;
  std::vector<documents::Location> locations;
  for (const documents::Occurrence& each : documents::occurrences(snapshot, name->name))
    if (params.wants_definitions || !each.is_definition)
      locations.push_back({snapshot.uri(), snapshot.to_client(each.line, each.span)});
  return locations;
}

Json references_capabilities(const Client&) { return {{"referencesProvider", true}}; }

}  // namespace

extern const Feature references = {.capabilities = references_capabilities,
                                   .methods = {on<&answer_references>("textDocument/references")}};

}  // namespace isocnc::lsp::features
