#include <optional>
#include <vector>

#include "lsp/features/feature.h"
#include "lsp/queries/names.h"

/// Lists the places where a label or a register is written.
namespace isocnc::features {
namespace {

struct ReferenceParams : protocol::PositionParams {
  bool wants_definitions = false;
};

void from_json(const Json& json, ReferenceParams& params) {
  from_json(json, static_cast<protocol::PositionParams&>(params));
  if (const auto context = protocol::member<Json>(json, "context"))
    params.wants_definitions = protocol::member<bool>(*context, "includeDeclaration").value_or(false);
}

std::optional<std::vector<protocol::Location>> answer_references(const Snapshot& snapshot,
                                                                 const ReferenceParams& params) {
  const auto name = queries::name_at(snapshot, snapshot.from_client(params.position));
  if (!name) return std::nullopt;
  std::vector<protocol::Location> locations;
  for (const queries::Occurrence& each : queries::occurrences(snapshot, name->name))
    if (params.wants_definitions || !each.is_definition)
      locations.push_back({snapshot.uri(), snapshot.to_client(each.line, each.span)});
  return locations;
}

Json references_capabilities(const Client&) { return {{"referencesProvider", true}}; }

}  // namespace

extern const Feature references = {.capabilities = references_capabilities,
                                   .methods = {on<&answer_references>("textDocument/references")}};

}  // namespace isocnc::features
