#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "lsp/rpc/loop.h"
#include "lsp/rpc/serve.h"

namespace isocnc::rpc {

/// A peer inside a program that has an event loop of its own, such as a page: the host hands in the messages, and lets
/// the peer work between its own events. Nothing runs but during these calls, on the thread that calls.
class HostedPeer {
 public:
  /// `send` gets the bodies of messages for the client, during work().
  HostedPeer(const MakePeer& make_peer, Send send) : peer_(make_peer(loop_, std::move(send))) {}

  /// Takes the body of a message. The peer handles it in work().
  void receive(std::string body);

  /// Works on what is due, for about this time; one long task may take longer. Returns the time until there is more to
  /// do, 0 where there is now, or nothing while the peer waits for a message.
  std::optional<std::chrono::milliseconds> work(std::chrono::milliseconds time);

  /// Whether the conversation is over.
  bool is_done() const { return loop_.is_stopped(); }
  int exit_status() const { return peer_->exit_status(); }

 private:
  Loop loop_;
  std::unique_ptr<Peer> peer_;
};

}  // namespace isocnc::rpc
