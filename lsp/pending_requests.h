#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

#include "lsp/outbox.h"
#include "lsp/rpc/message.h"
#include "lsp/rpc/on_loop.h"

namespace isocnc::lsp {

/// A request that has no answer yet. Copies of it are used on any thread: the answer is made on the thread that calls,
/// and sent by the loop. If the request has been cancelled, it has its answer already, and nothing is sent.
class PendingRequest {
 public:
  /// Set when the request is cancelled.
  using CancelFlag = std::shared_ptr<const std::atomic<bool>>;

  PendingRequest(rpc::Json id, CancelFlag cancelled, rpc::OnLoop<std::string> send);

  const CancelFlag& cancel_flag() const { return cancelled_; }
  /// `result` is JSON text.
  void answer(std::string_view result) const;
  void fail(const rpc::Error& error) const;

 private:
  rpc::Json id_;
  CancelFlag cancelled_;
  rpc::OnLoop<std::string> send_;
};

/// The requests that have no answer yet. Used on the loop's thread only.
class PendingRequests {
 public:
  PendingRequests(rpc::Loop& loop, Outbox& outbox) : loop_(loop), outbox_(outbox) {}

  /// Refuses the request, and returns nothing, if another with the same id has no answer yet.
  std::optional<PendingRequest> add(const rpc::Call& call);
  /// Answers the request by an error; does nothing if it has its answer already.
  void cancel(const rpc::Json& id);
  /// Ends the work on all requests, and answers each by an error.
  void refuse_all();
  /// Ends the work on all requests, without an answer.
  void cancel_all();

 private:
  using Flag = std::shared_ptr<std::atomic<bool>>;

  void finish(const std::string& key, const Flag& flag, std::string body);

  rpc::Loop& loop_;
  Outbox& outbox_;
  std::unordered_map<std::string, Flag> flags_;  // By request id, as JSON text.
};

}  // namespace isocnc::lsp
