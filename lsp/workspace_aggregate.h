#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lsp/features/feature.h"
#include "lsp/outbox.h"
#include "lsp/pending_requests.h"
#include "lsp/rpc/on_loop.h"
#include "lsp/rpc/strand.h"

namespace isocnc::lsp {

/// The results of one request about the whole workspace, until all have arrived. Three threads take part, and the types
/// of the callbacks say which:
///
///     part_notifier()   the strand that has a result sends it at once, if the client wants partial results;
///     taker()           the loop collects the results;
///     combine()         a thread of the pool makes the answer of them, since they may be long.
class WorkspaceAggregate : public std::enable_shared_from_this<WorkspaceAggregate> {
 public:
  using Results = std::vector<std::string>;

  /// `awaited` is the number of calls of the taker after which all results have arrived.
  WorkspaceAggregate(features::WorkspaceRequest workspace_request, rpc::CallPointer call, PendingRequest request,
                     std::size_t awaited);

  /// Empty if the client has given no token for partial results.
  std::optional<rpc::OnWorker<std::string>> part_notifier(rpc::Loop& loop, Outbox& outbox) const;
  /// Keeps this object alive.
  rpc::OnLoop<Results> taker(rpc::Loop& loop, rpc::Pool& pool);

 private:
  void combine() const;

  const features::WorkspaceRequest workspace_request_;
  const rpc::CallPointer call_;
  const PendingRequest request_;
  const bool is_reported_in_parts_;
  Results results_;      // Changed on the loop's thread, until none is awaited.
  std::size_t awaited_;  // Used on the loop's thread only.
};

}  // namespace isocnc::lsp
