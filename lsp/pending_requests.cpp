#include "lsp/pending_requests.h"

#include <utility>

namespace isocnc::lsp {

PendingRequest::PendingRequest(rpc::Json id, CancelFlag cancelled, rpc::OnLoop<std::string> send)
    : id_(std::move(id)), cancelled_(std::move(cancelled)), send_(std::move(send)) {}

void PendingRequest::answer(std::string_view result) const { send_(rpc::result_message(id_, result)); }

void PendingRequest::fail(const rpc::Error& error) const { send_(rpc::error_message(id_, error.code(), error.what())); }

std::optional<PendingRequest> PendingRequests::add(const rpc::Call& call) {
  const std::string key = rpc::write(*call.id);
  const auto flag = std::make_shared<std::atomic<bool>>(false);
  if (!flags_.try_emplace(key, flag).second) {
    outbox_.refuse(call, rpc::ErrorCode::InvalidRequest, "a request with this id has no answer yet");
    return std::nullopt;
  }
  return PendingRequest(*call.id, flag,
                        {loop_, [this, key, flag](std::string body) { finish(key, flag, std::move(body)); }});
}

void PendingRequests::cancel(const rpc::Json& id) {
  const auto found = flags_.find(rpc::write(id));
  if (found == flags_.end()) return;
  found->second->store(true);
  flags_.erase(found);
  outbox_.send(rpc::error_message(id, rpc::ErrorCode::RequestCancelled, "the request has been cancelled"));
}

void PendingRequests::refuse_all() {
  for (const auto& [id, flag] : std::exchange(flags_, {})) {
    flag->store(true);
    outbox_.send(rpc::error_message(rpc::parse(id), rpc::ErrorCode::RequestCancelled, "the server is being shut down"));
  }
}

void PendingRequests::cancel_all() {
  for (const auto& [id, flag] : flags_) flag->store(true);
}

void PendingRequests::finish(const std::string& key, const Flag& flag, std::string body) {
  const auto found = flags_.find(key);
  if (found == flags_.end() || found->second != flag) return;  // Cancelled, and so answered.
  flags_.erase(found);
  outbox_.send(std::move(body));
}

}  // namespace isocnc::lsp
