#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "interpreter/system/connection.h"
#include "lsp/rpc/frame.h"

namespace isocnc::rpc {

/// Receives and sends frames, each direction on a thread of its own, so that the caller never waits for the other side.
/// Reads nothing more while the other side leaves too much of what was sent unread.
class Channel {
 public:
  struct Events {
    std::function<void(MessageFrame)> frame;  ///< Called on the reading thread.
    std::function<void()> end;                ///< Called when nothing more can be received, or sent.
  };

  Channel(std::unique_ptr<system::Connection> connection, Events events);
  Channel(const Channel&) = delete;
  Channel& operator=(const Channel&) = delete;
  /// Ends both threads, after writing all sent messages; gives up when the other side reads nothing for a second.
  ~Channel();

  /// Frames a message and sends it. May be called on any thread.
  void send(std::string body);

 private:
  void end();
  void read_all();
  void write_all();
  bool may_read();

  const std::unique_ptr<system::Connection> connection_;
  const Events events_;
  std::mutex mutex_;  // Guards the members below.
  std::condition_variable changed_;
  std::deque<std::string> unsent_;
  std::size_t unsent_bytes_ = 0;
  bool is_ending_ = false;
  bool is_broken_ = false;
  std::thread reader_;
  std::thread writer_;
};

}  // namespace isocnc::rpc
