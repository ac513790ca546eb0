#include "lsp/rpc/hosted_peer.h"

#include <algorithm>

namespace isocnc::rpc {

void HostedPeer::receive(std::string body) {
  loop_.post([this, body = std::move(body)]() mutable { peer_->receive({.body = std::move(body)}); });
}

std::optional<std::chrono::milliseconds> HostedPeer::work(std::chrono::milliseconds time) {
  const auto now = std::chrono::steady_clock::now();
  const auto next = loop_.run_due(now + time);
  if (!next) return std::nullopt;
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(*next - std::chrono::steady_clock::now());
  return std::max(left, std::chrono::milliseconds::zero());
}

}  // namespace isocnc::rpc
