#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "interpreter/dialect/diagnostic.h"
#include "lsp/rpc/frame.h"
#include "lsp/rpc/loop.h"

namespace isocnc::rpc {

/// Our side of the conversation with one client. Runs on the loop's thread, and stops the loop when it is done.
class Peer {
 public:
  virtual ~Peer() = default;

  virtual void receive(MessageFrame frame) = 0;
  /// The client sends nothing more.
  virtual void end() = 0;
  /// Called at intervals while no message arrives.
  virtual void idle() {}
  virtual int exit_status() const = 0;
};

/// Sends a message, given its body. May be called on any thread.
using Send = std::function<void(std::string body)>;
using MakePeer = std::function<std::unique_ptr<Peer>(Loop& loop, Send send)>;

/// Connects a peer with one client: by standard input and output or, with a port, by the first connection that
/// accept_on_loopback() accepts. When the peer is done, the process ends with its exit status, so this function returns
/// only if the port cannot be opened. `report` gets a text for users: `127.0.0.1:4711`, or why the port cannot be
/// opened, in `language`.
void serve(const std::optional<std::uint16_t>& port, dialect::Language language, const MakePeer& make_peer,
           const std::function<void(const std::string&)>& report);

}  // namespace isocnc::rpc
