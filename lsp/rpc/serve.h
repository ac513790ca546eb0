#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "lsp/rpc/frame.h"
#include "lsp/rpc/loop.h"

namespace isocnc::lsp::rpc {

/// Who speaks with a client. All on the loop's thread, which it stops when it is done.
class Peer {
 public:
  virtual ~Peer() = default;

  virtual void receive(Frame frame) = 0;
  /// Nothing more will come.
  virtual void end() = 0;
  /// Called now and then while nothing comes.
  virtual void idle() {}
  virtual int exit_status() const = 0;
};

/// Takes the body of a message; any thread.
using Send = std::function<void(std::string body)>;
using MakePeer = std::function<std::unique_ptr<Peer>(Loop& loop, Send send)>;

/// Lets a party speak with one client, by standard input and output or, with a port, over the first connection to it,
/// which accept_on_loopback() waits for. Then the process ends, with the party's exit status: so this returns only
/// where the port cannot be had. `tell` is given what people want to know of the port: `127.0.0.1:4711`, or why not.
void serve(const std::optional<std::uint16_t>& port, const MakePeer& make_peer,
           const std::function<void(const std::string&)>& report);

}  // namespace isocnc::lsp::rpc
