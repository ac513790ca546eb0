#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "interpreter/syntax/characters.h"
#include "lsp/documents/outline.h"
#include "lsp/features/feature.h"

/// The sections of all open programs that a user may look for.
namespace isocnc::lsp::features {
namespace {

/// Symbols that are told of one program: who has more in mind goes on typing.
constexpr std::size_t kMostSymbols = 1000;

struct Query {
  std::string text;
};

void from_json(const Json& json, Query& query) { query.text = json.at("query"); }

struct Symbol {
  std::string name;
  int kind = 0;
  documents::Location location;
};

void to_json(Json& json, const Symbol& symbol) {
  json = {{"name", symbol.name}, {"kind", symbol.kind}, {"location", symbol.location}};
}

/// Whether the characters of the query come in the text, in their order, whatever stands between them.
bool fits(std::string_view text, std::string_view query) {
  std::size_t matched = 0;
  for (const char c : text)
    if (matched < query.size() && syntax::upper(c) == syntax::upper(query[matched])) ++matched;
  return matched == query.size();
}

std::vector<Symbol> answer_workspace_symbols(const Snapshot& snapshot, const Query& query) {
  std::vector<Symbol> symbols;
  for (const documents::Section& section : documents::outline(snapshot)) {
    if (symbols.size() == kMostSymbols) break;
    const std::string name =
        section.detail.empty() ? section.title : fmt::format("{} {}", section.title, section.detail);
    if (fits(name, query.text))
      symbols.push_back({name,
                         documents::symbol_kind(section.kind),
                         {snapshot.uri(), snapshot.to_client(section.head_line, section.head)}});
  }
  return symbols;
}

Json workspace_symbols_capabilities(const Client&) { return {{"workspaceSymbolProvider", true}}; }

}  // namespace

extern const Feature workspace_symbols = {.capabilities = workspace_symbols_capabilities,
                                          .gatherings = {on_each<&answer_workspace_symbols>("workspace/symbol")}};

}  // namespace isocnc::lsp::features
