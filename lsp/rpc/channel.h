#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "lsp/rpc/frame.h"

namespace isocnc::lsp::rpc {

/// Two descriptors to speak through, one to read from and one to write to; for a socket they are the same.
struct Descriptors {
  int in = 0;
  int out = 1;
};

/// Frames in and out, each direction on a thread of its own, so that nobody waits for the other side. While much has
/// not been read by the other side, nothing more is read from it.
class Channel {
 public:
  struct Events {
    std::function<void(Frame)> frame;  ///< On the reading thread.
    std::function<void()> end;         ///< Nothing more will come, or can be said.
  };

  Channel(Descriptors descriptors, Events events);
  Channel(const Channel&) = delete;
  Channel& operator=(const Channel&) = delete;
  /// Ends both threads. What has been sent is written before, unless the other side does not read it for a second.
  ~Channel();

  /// Frames a message and sends it; any thread.
  void send(std::string body);

 private:
  void end();
  void read_all();
  void write_all();
  bool write_some(std::string_view& bytes) const;
  bool wait_for(int descriptor, short events, bool until_deadline) const;
  bool may_read();

  const Descriptors descriptors_;
  const Events events_;
  int stop_pipe_[2] = {-1, -1};  // Readable once the channel is to end.
  std::mutex mutex_;             // Guards all below.
  std::condition_variable changed_;
  std::deque<std::string> unsent_;
  std::size_t unsent_bytes_ = 0;
  bool is_ending_ = false;
  bool is_broken_ = false;
  std::thread reader_;
  std::thread writer_;
};

}  // namespace isocnc::lsp::rpc
