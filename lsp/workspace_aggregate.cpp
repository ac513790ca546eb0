#include "lsp/workspace_aggregate.h"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace isocnc::lsp {

using rpc::Json;

/// The client's token for partial results.
static std::optional<Json> part_token_of(const rpc::Call& call) {
  return protocol::member<Json>(call.params(), "partialResultToken");
}

WorkspaceAggregate::WorkspaceAggregate(features::WorkspaceRequest workspace_request, rpc::CallPointer call,
                                       PendingRequest request, std::size_t awaited)
    : workspace_request_(workspace_request),
      call_(std::move(call)),
      request_(std::move(request)),
      is_reported_in_parts_(part_token_of(*call_).has_value()),
      awaited_(awaited) {}

std::optional<rpc::OnWorker<std::string>> WorkspaceAggregate::part_notifier(rpc::Loop& loop, Outbox& outbox) const {
  const auto token = part_token_of(*call_);
  if (!token) return std::nullopt;
  const rpc::OnLoop<std::string> notify(loop, [&outbox, cancelled = request_.cancel_flag()](const std::string& params) {
    if (!cancelled->load()) outbox.notify("$/progress", params);
  });
  return rpc::OnWorker<std::string>([notify, call = call_, combine = workspace_request_.combine,
                                     token = rpc::write(*token)](const std::string& result) {
    if (result == "[]") return;
    try {
      const std::string part = combine(result, call->params(), features::AggregateScope::Some);
      notify(fmt::format(R"({{"token":{},"value":{}}})", token, part));
    } catch (const Json::exception&) {
      return;  // The error in the parameters is reported with the final answer.
    }
  });
}

rpc::OnLoop<WorkspaceAggregate::Results> WorkspaceAggregate::taker(rpc::Loop& loop, rpc::Pool& pool) {
  return {loop, [self = shared_from_this(), &pool](Results results) {
            std::move(results.begin(), results.end(), std::back_inserter(self->results_));
            if (--self->awaited_ == 0) pool.post([self] { self->combine(); });
          }};
}

/// Joins JSON arrays into one.
static std::string joined(const std::vector<std::string>& arrays) {
  std::string all = "[";
  for (const std::string& array : arrays) {
    const std::string_view items = std::string_view(array).substr(1, array.size() - 2);
    if (items.empty()) continue;
    if (all.size() > 1) all += ',';
    all += items;
  }
  return all + "]";
}

void WorkspaceAggregate::combine() const {
  const auto scope = is_reported_in_parts_ ? features::AggregateScope::Rest : features::AggregateScope::All;
  try {
    request_.answer(workspace_request_.combine(joined(results_), call_->params(), scope));
  } catch (const Json::exception& error) {
    request_.fail(rpc::Error(rpc::ErrorCode::InvalidParams, error.what()));
  }
}

}  // namespace isocnc::lsp
