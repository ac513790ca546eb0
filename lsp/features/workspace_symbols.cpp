#include <map>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "interpreter/text/characters.h"
#include "lsp/features/feature.h"
#include "lsp/queries/outline.h"

/// Workspace symbols: the sections of all programs in the workspace.
namespace isocnc::features {
namespace {

/// The maximum number of symbols of one program; to see others the user types more of the name.
constexpr std::size_t kMaxSymbols = 1000;

/// The text to look for; without a text, all symbols match.
struct Query {
  std::optional<std::string> text;
};

void from_json(const Json& json, Query& query) { query.text = protocol::member<std::string>(json, "query"); }

struct Symbol {
  std::string name;
  int kind = 0;
  protocol::Location location;
};

void to_json(Json& json, const Symbol& symbol) {
  json = {{"name", symbol.name}, {"kind", symbol.kind}, {"location", symbol.location}};
}

/// Whether the characters of the query occur in the text in their order, with any characters between them.
bool fits(std::string_view text, std::string_view query) {
  std::size_t matched = 0;
  for (const char c : text)
    if (matched < query.size() && text::upper(c) == text::upper(query[matched])) ++matched;
  return matched == query.size();
}

std::vector<Symbol> answer_workspace_symbols(const Snapshot& snapshot, const Query& query) {
  std::vector<Symbol> symbols;
  for (const queries::Section& section : queries::outline(snapshot)) {
    if (query.text && symbols.size() == kMaxSymbols) break;
    const std::string name =
        section.detail.empty() ? section.title : fmt::format("{} {}", section.title, section.detail);
    if (fits(name, query.text.value_or("")))
      symbols.push_back({name,
                         queries::symbol_kind(section.kind),
                         {snapshot.uri(), snapshot.to_client(section.head_line, section.head)}});
  }
  return symbols;
}

/// Closed programs answer with all their symbols, so the query is applied here.
std::string conclude_symbols(const std::string& results, const Json& params, AggregateScope scope) {
  if (scope == AggregateScope::Rest) return "[]";
  const std::string query = params.at("query");
  std::map<std::string, std::size_t> counts;
  std::string all = "[";
  for (const Json& symbol : Json::parse(results)) {
    if (!fits(symbol["name"].get_ref<const std::string&>(), query)) continue;
    if (++counts[symbol["location"]["uri"]] > kMaxSymbols) continue;
    if (all.size() > 1) all += ',';
    all += rpc::write(symbol);
  }
  return all + "]";
}

Json workspace_symbols_capabilities(const Client&) { return {{"workspaceSymbolProvider", true}}; }

}  // namespace

extern const Feature workspace_symbols = {
    .capabilities = workspace_symbols_capabilities,
    .workspace_requests = {workspace_request<&answer_workspace_symbols>("workspace/symbol", conclude_symbols)}};

}  // namespace isocnc::features
