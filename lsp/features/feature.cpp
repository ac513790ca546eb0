#include "lsp/features/feature.h"

#include <algorithm>

namespace isocnc::features {

/// Whether `kind` is `other` or one of its subkinds: `refactor.rewrite` is a subkind of `refactor`.
static bool is_below(std::string_view kind, std::string_view other) {
  return kind.starts_with(other) && (kind.size() == other.size() || kind[other.size()] == '.' || other.empty());
}

bool ActionParams::wants(std::string_view kind) const {
  return only.empty() || std::any_of(only.begin(), only.end(), [&](const auto& each) { return is_below(kind, each); });
}

void from_json(const Json& json, ActionParams& params) {
  from_json(json, static_cast<protocol::RangeParams&>(params));
  const Json& context = json.at("context");
  params.only = protocol::member<std::vector<std::string>>(context, "only").value_or(std::vector<std::string>{});
  params.diagnostics = protocol::member<std::vector<Json>>(context, "diagnostics").value_or(std::vector<Json>{});
}

bool ActionParams::may_want(std::string_view kind) const {
  return wants(kind) || std::any_of(only.begin(), only.end(), [&](const auto& each) { return is_below(each, kind); });
}

void to_json(Json& json, const TextContent& content) { json = {{"text", content.text}}; }

}  // namespace isocnc::features
