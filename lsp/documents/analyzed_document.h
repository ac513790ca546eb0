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
#include "lsp/documents/kept_run.h"
#include "lsp/documents/program_index.h"
#include "lsp/documents/settings_store.h"
#include "lsp/protocol/encoding.h"
#include "lsp/protocol/protocol.h"

namespace isocnc::documents {

/// One step of a `didChange`: the new text of a range, or without a range of the whole document.
struct ContentChange {
  std::optional<protocol::ClientRange> range;
  std::string text;
};

/// A program that the editor has open: its text as it is edited, and its one analysis. Used on its strand only;
/// features see it as a Snapshot. Reads no files before open().
class AnalyzedDocument {
 public:
  AnalyzedDocument(std::string uri, SettingsStore& settings);

  /// Replaces the whole text.
  void open(std::int64_t version, std::string_view text);
  /// Applies the changes one after another, each to the text that results from the one before.
  void edit(std::int64_t version, const std::vector<ContentChange>& changes, protocol::Encoding encoding);
  /// Reads the settings again, since configuration files may have changed.
  void reread_settings();
  /// Brings the analysis up to date with the text. Calls `stop` at intervals; when that returns true, leaves the rest
  /// for the next call and returns false.
  bool update(const std::function<bool()>& stop = {});
  /// The same for the frontier before a line alone.
  bool update_before(std::size_t line, const std::function<bool()>& stop);
  /// check::Analysis::has_known_findings().
  bool has_known_findings() const { return analysis_ && analysis_->has_known_findings(); }

  const std::string& uri() const { return uri_; }
  std::int64_t version() const { return version_; }
  const syntax::Document& document() const { return document_; }
  const DocumentSettings& settings() const { return settings_; }
  /// The members below are as of the last update(), or of one before it (has_known_findings()).
  const check::Analysis& analysis() const { return *analysis_; }
  const check::Report& report();
  /// The first findings of the report, at least `maximum` unless there are fewer, and the number of findings after
  /// them. Without those that only a run shows.
  check::FirstFindings excerpt(std::size_t maximum);
  /// The findings of the report that only a run shows (LocatedFinding::is_of_run).
  check::FirstFindings run_excerpt();
  /// The report's findings on a line, repetitions included. If the report is very long, paths are missing, and so are
  /// findings that depend on the whole program.
  std::vector<check::LocatedFinding> findings_on(std::size_t line);
  const ProgramIndex& index();

  /// A number that changes with the text and the settings.
  std::uint64_t revision() const { return revision_; }
  /// The size of the text in bytes.
  std::size_t size() const;
  /// What the last verification has shown, as far as it still applies; null if there was none.
  const KeptRun* run() const { return run_ ? &*run_ : nullptr; }
  std::optional<simulation::RemovedOnLine> removed_on(std::size_t line) const;
  std::optional<double> removed_between(std::size_t first, std::size_t end) const;
  /// Takes what a verification of the present revision has shown. From now on it is a part of the report.
  void take_run(simulation::RunOutcome outcome);
  void drop_run();

  protocol::ClientPosition to_client(const syntax::Position& position, protocol::Encoding encoding) const;
  syntax::Position from_client(const protocol::ClientPosition& position, protocol::Encoding encoding) const;

  /// Data that features keep about the document: one object of each type.
  template <class T>
  T& memory() {
    std::any& slot = memories_[std::type_index(typeid(T))];
    if (!slot.has_value()) slot.emplace<T>();
    return *std::any_cast<T>(&slot);
  }

 private:
  void replace(const ContentChange& change, protocol::Encoding encoding);
  void replace_all(std::int64_t version, std::string_view text);
  /// A line as it was before an edit.
  struct OldLine {
    std::size_t line = 0;
    std::string_view text;
  };
  void move_run(const OldLine& first, const OldLine& last, std::size_t line_count);
  bool is_known(const simulation::RunFinding& of_run) const;
  check::Report shown_report();
  bool is_long();
  check::Analysis& begun_analysis();
  selection::Suppressions read_suppressions();

  const std::string uri_;
  SettingsStore& store_;
  DocumentSettings settings_;
  std::int64_t version_ = 0;
  syntax::Document document_;
  bool has_byte_order_mark_ = false;  // Whether the text starts with a mark; it is not part of document_.
  std::optional<check::Analysis> analysis_;
  bool is_up_to_date_ = false;
  std::optional<check::Report> report_;  // The report, made on the first request.
  std::uint64_t revision_ = 0;
  std::optional<KeptRun> run_;
  ProgramIndex index_;
  syntax::PerChunk<bool> has_suppressions_;  // Whether a chunk may have comments that silence isolint.
  std::unordered_map<std::type_index, std::any> memories_;
};

}  // namespace isocnc::documents
