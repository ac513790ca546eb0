#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "lsp/features/feature.h"

/// Code actions: lists what the other features offer for some lines. If the client can resolve actions, an edit that
/// takes time is made only after the user has chosen it.
namespace isocnc::lsp::features {

/// Whether `kind` is `other` or one of its subkinds: `refactor.rewrite` is a subkind of `refactor`.
static bool is_below(std::string_view kind, std::string_view other) {
  return kind.starts_with(other) && (kind.size() == other.size() || kind[other.size()] == '.' || other.empty());
}

bool ActionParams::wants(std::string_view kind) const {
  return only.empty() || std::any_of(only.begin(), only.end(), [&](const auto& each) { return is_below(kind, each); });
}

void from_json(const Json& json, ActionParams& params) {
  from_json(json, static_cast<documents::RangeParams&>(params));
  const Json& context = json.at("context");
  params.only = documents::member<std::vector<std::string>>(context, "only").value_or(std::vector<std::string>{});
  params.diagnostics = documents::member<std::vector<Json>>(context, "diagnostics").value_or(std::vector<Json>{});
}

namespace {

/// An action, with the index of its source.
struct Offer {
  Action action;
  std::size_t source = 0;
};

struct ActionResolveParams {
  Json action;
};

void from_json(const Json& json, ActionResolveParams& params) { params.action = json; }

std::vector<const ActionSource*> sources() {
  std::vector<const ActionSource*> all;
  for (const Feature* const feature : all_features())
    for (const ActionSource& source : feature->actions) all.push_back(&source);
  return all;
}

/// Whether the client requests an action's edit separately, after the user has chosen the action.
bool resolves(const Client& client) {
  const Json properties = client.capabilities.value(
      Json::json_pointer("/textDocument/codeAction/resolveSupport/properties"), Json::array());
  return std::find(properties.begin(), properties.end(), Json("edit")) != properties.end();
}

/// Makes the edit at once. Returns false if there is nothing to edit.
bool complete(const Snapshot& snapshot, const ActionSource& source, Action& action) {
  try {
    action.edit = source.edit(snapshot, action.data);
    return true;
  } catch (const rpc::Error& error) {
    if (error.code() != rpc::ErrorCode::RequestFailed) throw;
    return false;
  }
}

/// Whether the action has an edit, or the client will ask for it. For other clients the edit is made at once, but only
/// if they ask for this kind of action: not at each move of the cursor.
bool is_at_hand(const Snapshot& snapshot, const ActionParams& params, const ActionSource& source, Action& action) {
  if (action.edit || resolves(snapshot.client())) return true;
  return !params.only.empty() && complete(snapshot, source, action);
}

/// Whether the client wants this kind or one of its subkinds.
bool may_be_wanted(const ActionParams& params, std::string_view kind) {
  return params.wants(kind) || std::any_of(params.only.begin(), params.only.end(),
                                           [&](const std::string& each) { return is_below(each, kind); });
}

Json written(const Snapshot& snapshot, const Offer& offer) {
  const Action& action = offer.action;
  Json json = {{"title", action.title}, {"kind", action.kind}};
  if (action.is_preferred) json["isPreferred"] = true;
  if (!action.diagnostics.is_null()) json["diagnostics"] = action.diagnostics;
  if (action.edit) {
    json["edit"] = *action.edit;
  } else {
    json["data"] = {
        {"uri", snapshot.uri()}, {"version", snapshot.version()}, {"source", offer.source}, {"action", action.data}};
  }
  return json;
}

Json offer(const Snapshot& snapshot, const ActionParams& params) {
  Json all = Json::array();
  const std::vector<const ActionSource*> offering = sources();
  for (std::size_t i = 0; i < offering.size(); ++i) {
    if (!may_be_wanted(params, offering[i]->kind)) continue;
    std::vector<Action> actions;
    offering[i]->offer(snapshot, params, actions);
    for (Action& action : actions)
      if (params.wants(action.kind) && is_at_hand(snapshot, params, *offering[i], action))
        all.push_back(written(snapshot, {std::move(action), i}));
  }
  return all;
}

Json resolve_action(const Snapshot& snapshot, const ActionResolveParams& params) {
  const Json& data = params.action.at("data");
  if (data.at("version") != snapshot.version())
    throw rpc::Error(rpc::ErrorCode::ContentModified, "the document has been edited");
  Json action = params.action;
  action["edit"] = sources().at(data.at("source"))->edit(snapshot, data.at("action"));
  return action;
}

Json code_actions_capabilities(const Client&) {
  Json kinds = Json::array();
  for (const ActionSource* const source : sources())
    if (std::find(kinds.begin(), kinds.end(), Json(source->kind)) == kinds.end()) kinds.push_back(source->kind);
  return {{"codeActionProvider", {{"codeActionKinds", kinds}, {"resolveProvider", true}}}};
}

}  // namespace

extern const Feature code_actions = {
    .capabilities = code_actions_capabilities,
    .methods = {on<&offer>("textDocument/codeAction"), on<&resolve_action>("codeAction/resolve")}};

}  // namespace isocnc::lsp::features
