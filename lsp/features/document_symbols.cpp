#include <string>
#include <vector>

#include "lsp/features/feature.h"
#include "lsp/queries/outline.h"

/// The program's outline: tools, frames, labels and headings.
namespace isocnc::features {

using queries::Section;

namespace {

/// Writes the sections nested if the client supports that, else as a flat list.
class SymbolWriter {
 public:
  explicit SymbolWriter(const Snapshot& snapshot) : snapshot_(snapshot), sections_(queries::outline(snapshot)) {}

  protocol::RawJson tree() {
    write_children(-1);
    return {std::move(text_)};
  }

  protocol::RawJson row() {
    text_ = "[";
    for (const Section& section : sections_) {
      snapshot_.throw_if_unwanted();
      separate();
      Json json = {{"name", section.title},
                   {"kind", queries::symbol_kind(section.kind)},
                   {"location", protocol::Location{snapshot_.uri(), range_of(section)}}};
      if (section.parent >= 0) json["containerName"] = sections_[static_cast<std::size_t>(section.parent)].title;
      text_ += rpc::write(json);
    }
    text_ += "]";
    return {std::move(text_)};
  }

 private:
  ClientRange range_of(const Section& section) const {
    const std::size_t end = snapshot_.document().text_of_line(section.last_line).size();
    return {snapshot_.to_client({section.first_line, 0}), snapshot_.to_client({section.last_line, end})};
  }

  /// A section comes after the one that holds it, so they are written in their order.
  void write_children(int parent) {
    text_ += "[";
    while (next_ < sections_.size() && sections_[next_].parent == parent) {
      snapshot_.throw_if_unwanted();
      const Section& section = sections_[next_];
      separate();
      std::string symbol = rpc::write({{"name", section.title},
                                       {"detail", section.detail},
                                       {"kind", queries::symbol_kind(section.kind)},
                                       {"range", range_of(section)},
                                       {"selectionRange", snapshot_.to_client(section.head_line, section.head)}});
      symbol.pop_back();
      text_ += symbol + ",\"children\":";
      write_children(static_cast<int>(next_++));
      text_ += "}";
    }
    text_ += "]";
  }

  void separate() {
    if (text_.back() != '[') text_ += ",";
  }

  const Snapshot& snapshot_;
  const std::vector<Section> sections_;
  std::size_t next_ = 0;
  std::string text_;
};

protocol::RawJson answer_document_symbols(const Snapshot& snapshot, const protocol::DocumentParams&) {
  SymbolWriter writer(snapshot);
  return snapshot.client().can("/textDocument/documentSymbol/hierarchicalDocumentSymbolSupport") ? writer.tree()
                                                                                                 : writer.row();
}

Json document_symbols_capabilities(const Client&) { return {{"documentSymbolProvider", true}}; }

}  // namespace

extern const Feature document_symbols = {.capabilities = document_symbols_capabilities,
                                         .methods = {on<&answer_document_symbols>("textDocument/documentSymbol")}};

}  // namespace isocnc::features
