#include "lsp/documents/snapshot.h"

namespace isocnc::documents {

rpc::Error edited() { return {rpc::ErrorCode::ContentModified, "the document has been edited"}; }

/// Asks whether the analysis is to be left. Some lines are checked before it is left for other work.
std::function<bool()> Snapshot::stop() const {
  return [this, chunks = 0]() mutable {
    return !is_wanted() ||
           (++chunks % check::Analysis::kChunksInAMoment == 0 && interest_.others_wait && interest_.others_wait());
  };
}

AnalyzedDocument& Snapshot::updated() const {
  if (findings_ == ShownFindings::All && !document_.update(stop())) leave();
  return document_;
}

check::Frontier Snapshot::frontier_before(std::size_t line) const {
  if (!document_.update_before(line, stop())) leave();
  return document_.analysis().frontier_before(line);
}

/// Where the analysis has been stopped.
void Snapshot::leave() const {
  throw_if_unwanted();
  throw Postponed();
}

bool Snapshot::is_wanted() const {
  const bool is_cancelled = interest_.cancelled && interest_.cancelled->load();
  return !is_cancelled && (!interest_.edits_waiting || interest_.edits_waiting->load() == 0);
}

std::optional<execution::State> Snapshot::state_before(std::size_t line) const {
  const check::Frontier frontier = frontier_before(line);
  if (line >= document().line_count()) return frontier.state_at({});
  const syntax::DocumentLine next = document().line(line);
  return frontier.state_at(*next);
}

void Snapshot::throw_if_unwanted() const {
  if (interest_.cancelled && interest_.cancelled->load())
    throw rpc::Error(rpc::ErrorCode::RequestCancelled, "the request has been cancelled");
  if (interest_.edits_waiting && interest_.edits_waiting->load() > 0) throw edited();
}

}  // namespace isocnc::documents
