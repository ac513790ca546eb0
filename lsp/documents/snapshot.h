#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "lsp/documents/analyzed_document.h"
#include "lsp/documents/client.h"

namespace isocnc::lsp::documents {

/// Who wants an answer, and whether they still do.
struct Interest {
  const std::atomic<bool>* cancelled = nullptr;     ///< Set once the client does not want it any more.
  const std::atomic<int>* edits_waiting = nullptr;  ///< Edits that wait until the answer is given.
};

/// What a feature sees of a program: one version of it, with the one analysis that all features share. Nothing of it
/// changes while a feature looks at it, and it ends with the call: what a feature wants to keep, it copies, or leaves
/// in memory(). No feature parses text for itself.
///
///     text, trees     document().line(n): a LineTree with its words, findings, text
///     findings        report(): what isolint would tell, by line and column
///     states          state_before(n), frontier_before(n): checked from the chunk's start, a few microseconds
///     labels, ...     index()
///     configuration   setup(), selection(), configuration()
///     places          position(), range(): between the client's columns and bytes
///     the reader      language(), client()
class Snapshot {
 public:
  /// Brings the analysis up to date; throws as give_way() does when that takes long and is not wanted any more.
  Snapshot(AnalyzedDocument& document, const Client& client, const Interest& interest);

  const std::string& uri() const { return document_.uri(); }
  std::int64_t version() const { return document_.version(); }

  const syntax::Document& document() const { return document_.document(); }
  const check::Report& report() const { return document_.report(); }
  /// The first findings of the report, at least so many, and how many there are behind them: a program may have a
  /// hundred thousand, after each edit.
  check::FirstFindings excerpt(std::size_t maximum) const { return document_.excerpt(maximum); }
  /// Of the report, those on a line.
  std::vector<check::LocatedFinding> findings_on(std::size_t line) const { return document_.findings_on(line); }
  const check::Analysis& analysis() const { return document_.analysis(); }
  /// Where all paths stand before a line; lines behind the end count as the end.
  check::Frontier frontier_before(std::size_t line) const { return document_.analysis().frontier_before(line); }
  /// Where labels, jumps, registers, tools and frames stand.
  const ProgramIndex& index() const { return document_.index(); }
  /// The state before a line, of all that comes from above or has jumped to it, where there is only one: none where no
  /// path leads there, or where paths differ.
  std::optional<execution::State> state_before(std::size_t line) const;

  const execution::Setup& setup() const { return document_.settings().program->setup; }
  const selection::Selection& selection() const { return document_.settings().program->selection; }
  const configuration::Configuration& configuration() const { return *document_.settings().configuration; }
  /// Who keeps all three after the call, for what goes on with them.
  std::shared_ptr<const void> settings_owner() const { return document_.settings().owner; }

  const Client& client() const { return client_; }
  dialect::Language language() const { return client_.language(configuration().language); }

  ClientPosition to_client(const syntax::Position& position) const {
    return document_.to_client(position, client_.encoding);
  }
  ClientRange to_client(std::size_t line, syntax::Span span) const {
    return {to_client({line, span.begin}), to_client({line, span.end})};
  }
  /// Places outside the document count as the nearest inside.
  syntax::Position from_client(const ClientPosition& position) const {
    return document_.from_client(position, client_.encoding);
  }

  /// What a feature remembers of this document from one request to the next; empty at first. Each type is one memory.
  template <class T>
  T& memory() const {
    return document_.memory<T>();
  }

  /// To be called now and then by who takes long, once for each thousand lines or so: throws rpc::Error where the
  /// answer is not wanted any more, or an edit waits for it.
  void throw_if_unwanted() const;

 private:
  bool is_wanted() const;

  AnalyzedDocument& document_;
  const Client& client_;
  const Interest interest_;
};

}  // namespace isocnc::lsp::documents
