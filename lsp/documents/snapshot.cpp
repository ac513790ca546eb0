#include "lsp/documents/snapshot.h"

#include "lsp/rpc/message.h"

namespace isocnc::documents {

Snapshot::Snapshot(AnalyzedDocument& document, const protocol::Client& client, const Interest& interest)
    : document_(document), client_(client), interest_(interest) {
  const bool is_done = document_.update([&] { return !is_wanted(); });
  if (!is_done) throw_if_unwanted();
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
  if (interest_.edits_waiting && interest_.edits_waiting->load() > 0)
    throw rpc::Error(rpc::ErrorCode::ContentModified, "the document has been edited");
}

}  // namespace isocnc::documents
