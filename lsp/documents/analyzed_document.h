#pragma once

#include <any>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <typeindex>
#include <unordered_map>
#include <vector>

#include "analyzer/check/analysis.h"
#include "analyzer/selection/suppressions.h"
#include "interpreter/syntax/per_chunk.h"
#include "lsp/documents/encoding.h"
#include "lsp/documents/program_index.h"
#include "lsp/documents/protocol.h"
#include "lsp/documents/settings_store.h"

namespace isocnc::lsp::documents {

/// One step of a `didChange`: a range that gets another text, or without one the whole text.
struct ContentChange {
  std::optional<ClientRange> range;
  std::string text;
};

/// A program that the editor holds open: its text as it is edited, and its one analysis. Belongs to its strand; what
/// features see of it is a Snapshot. Nothing is read, nor looked for in files, before open().
class AnalyzedDocument {
 public:
  AnalyzedDocument(std::string uri, SettingsStore& settings);

  /// Takes the text in the place of all that was there.
  void open(std::int64_t version, std::string_view text);
  /// Makes the changes, each in the text that the one before has left.
  void edit(std::int64_t version, const std::vector<ContentChange>& changes, Encoding encoding);
  /// The configuration files may say something else now.
  void reread_settings();
  /// Brings the analysis up to date with the text. Asked now and then whether to `stop`, it may leave the rest for
  /// the next time: false.
  bool update(const std::function<bool()>& stop = {});

  const std::string& uri() const { return uri_; }
  std::int64_t version() const { return version_; }
  const syntax::Document& document() const { return document_; }
  const DocumentSettings& settings() const { return settings_; }
  /// The rest is as of the last update.
  const check::Analysis& analysis() const { return *analysis_; }
  const check::Report& report();
  /// The first findings of the report, at least so many, and how many there are behind them.
  check::FirstFindings excerpt(std::size_t maximum);
  /// The report's findings on a line; of a report with very many, without their paths and those that only the whole
  /// program shows.
  std::vector<check::LocatedFinding> findings_on(std::size_t line);
  const ProgramIndex& index();

  ClientPosition to_client(const syntax::Position& position, Encoding encoding) const;
  syntax::Position from_client(const ClientPosition& position, Encoding encoding) const;

  /// What features remember of the document: one value of each type.
  template <class T>
  T& memory() {
    std::any& slot = memories_[std::type_index(typeid(T))];
    if (!slot.has_value()) slot.emplace<T>();
    return *std::any_cast<T>(&slot);
  }

 private:
  void replace(const ContentChange& change, Encoding encoding);
  check::Report shown_report();
  bool is_long();
  selection::Suppressions read_suppressions();

  const std::string uri_;
  SettingsStore& store_;
  DocumentSettings settings_;
  std::int64_t version_ = 0;
  syntax::Document document_;
  bool has_byte_order_mark_ = false;  // Before the text; no part of the document.
  std::optional<check::Analysis> analysis_;
  bool is_up_to_date_ = false;
  std::optional<check::Report> report_;  // Once somebody has asked.
  ProgramIndex index_;
  syntax::PerChunk<bool> has_suppressions_;  // To isolint, perhaps, in its comments.
  std::unordered_map<std::type_index, std::any> memories_;
};

}  // namespace isocnc::lsp::documents
