#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lsp/documents/analyzed_document.h"
#include "lsp/protocol/client.h"
#include "lsp/rpc/message.h"

namespace isocnc::documents {

/// Tells whether an answer is still wanted.
struct Interest {
  const std::atomic<bool>* cancelled = nullptr;     ///< Set when the client cancels the request.
  const std::atomic<int>* edits_waiting = nullptr;  ///< The number of edits that wait for the answer.
  std::function<bool()> others_wait = {};           ///< Whether other work on the document waits for the answer.
};

/// Thrown where the analysis is behind the text and other work on the document waits: it is to be tried again after
/// that, and comes further then.
struct Postponed {};

/// What a request gets if its document has been edited since the client asked.
rpc::Error edited();

/// A feature's view of a program: one version of it, with the one analysis that all features share. It does not change
/// during the call, and is not valid afterwards: a feature copies the data it keeps, or puts it into memory(). No
/// feature parses text itself.
///
///     text, trees     document().line(n): a LineTree with its words, findings, text
///     findings        report(): the findings of isolint, by line and column; this and excerpt(), findings_on() and
///                     analysis() bring the analysis up to date
///     states          state_before(n), frontier_before(n): checked from the chunk's start, a few microseconds, once
///     the
///                     analysis has come to that line
///     labels, ...     index()
///     configuration   setup(), selection(), configuration()
///     places          position(), range(): between the client's columns and bytes
///     the reader      language(), client()
class Snapshot {
 public:
  /// Which findings a snapshot shows.
  enum class ShownFindings : std::uint8_t {
    All,
    Known,  ///< What is known so far; below the lines checked since an edit, the findings of the earlier text.
  };

  /// Members that bring the analysis up to date throw like throw_if_unwanted() if the answer is no longer wanted before
  /// that is done, or Postponed.
  Snapshot(AnalyzedDocument& document, const protocol::Client& client, Interest interest,
           ShownFindings findings = ShownFindings::All)
      : document_(document), client_(client), interest_(std::move(interest)), findings_(findings) {}

  const std::string& uri() const { return document_.uri(); }
  std::int64_t version() const { return document_.version(); }

  const syntax::Document& document() const { return document_.document(); }
  const check::Report& report() const { return updated().report(); }
  /// The first findings of the report, at least `maximum` unless there are fewer, and the number of findings after
  /// them: a program may have 100,000 after each edit. Without those that only a run shows.
  check::FirstFindings excerpt(std::size_t maximum) const { return updated().excerpt(maximum); }
  /// The findings of the report that only a run shows, from the last verification. They are part of report() as well.
  check::FirstFindings run_excerpt() const { return updated().run_excerpt(); }
  /// Whether the last verification was one of this text with these settings. Otherwise its findings may be outdated.
  bool is_verified() const { return document_.run() && document_.run()->is_current(); }
  /// What the motions of a line have removed from the blank, if the verification of the present text has cut one.
  std::optional<simulation::RemovedOnLine> removed_on(std::size_t line) const { return document_.removed_on(line); }
  /// The volume in mm^3 that the motions of the lines from `first` to before `end` have removed, in the same way.
  std::optional<double> removed_between(std::size_t first, std::size_t end) const {
    return document_.removed_between(first, end);
  }
  /// The findings of the report on a line.
  std::vector<check::LocatedFinding> findings_on(std::size_t line) const { return updated().findings_on(line); }
  const check::Analysis& analysis() const { return updated().analysis(); }
  /// The states of all paths before a line; lines after the end count as the end.
  check::Frontier frontier_before(std::size_t line) const;
  /// The places of labels, jumps, registers, tools and frames.
  const ProgramIndex& index() const { return document_.index(); }
  /// The state before a line, on paths from above and by jumps. Nothing if no path leads there, or if paths differ.
  std::optional<execution::State> state_before(std::size_t line) const;

  const execution::Setup& setup() const { return check_setup().machine; }
  const rules::CheckSetup& check_setup() const { return document_.settings().program->setup; }
  const selection::Selection& selection() const { return document_.settings().program->selection; }
  const configuration::Configuration& configuration() const { return *document_.settings().configuration; }
  /// All of the above, for background requests.
  const DocumentSettings& settings() const { return document_.settings(); }
  /// Keeps the three objects above alive after the call, for background requests.
  std::shared_ptr<const void> settings_owner() const { return document_.settings().owner; }

  const protocol::Client& client() const { return client_; }
  dialect::Language language() const { return client_.language(configuration().language); }

  protocol::ClientPosition to_client(const syntax::Position& position) const {
    return document_.to_client(position, client_.encoding);
  }
  protocol::ClientRange to_client(std::size_t line, syntax::Span span) const {
    return {to_client({line, span.begin}), to_client({line, span.end})};
  }
  /// Converts a position of the client; one outside the document becomes the nearest inside.
  syntax::Position from_client(const protocol::ClientPosition& position) const {
    return document_.from_client(position, client_.encoding);
  }

  /// Data that a feature keeps about this document from one request to the next, default-constructed at first. There is
  /// one object per type.
  template <class T>
  T& memory() const {
    return document_.memory<T>();
  }

  /// Throws rpc::Error if the answer is no longer wanted, or an edit waits for it. Long work calls this about once per
  /// thousand lines.
  void throw_if_unwanted() const;

 private:
  AnalyzedDocument& updated() const;
  bool is_wanted() const;
  std::function<bool()> stop() const;
  void leave() const;

  AnalyzedDocument& document_;
  const protocol::Client& client_;
  const Interest interest_;
  const ShownFindings findings_;
};

}  // namespace isocnc::documents
