#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "lsp/feature_list.h"

/// Code actions: lists what the features offer for some lines. If the client can resolve actions, an edit that
/// takes time is made only after the user has chosen it.
namespace isocnc::lsp {

using features::Action;
using features::ActionParams;
using features::ActionSource;
using features::Feature;
using features::on;
using features::Snapshot;
using protocol::Client;
using rpc::Json;

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
    if (!params.may_want(offering[i]->kind)) continue;
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
  if (data.at("version") != snapshot.version()) throw documents::edited();
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

}  // namespace isocnc::lsp
