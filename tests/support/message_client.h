#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include "lsp/rpc/json.h"
#include "lsp/rpc/serve.h"

namespace isocnc::support {

using rpc::Json;

/// A client in the test process. The loop of its peer runs on a thread of its own.
class MessageClient {
 public:
  explicit MessageClient(const rpc::MakePeer& make_peer)
      : party_(make_peer(loop_, [this](std::string body) { take(std::move(body)); })),
        thread_([this] { loop_.run(std::chrono::seconds(3), [] {}); }) {}
  MessageClient(const MessageClient&) = delete;
  MessageClient& operator=(const MessageClient&) = delete;
  ~MessageClient() {
    if (is_speaking()) hang_up();
  }

  void receive(rpc::MessageFrame frame) {
    loop_.post([this, frame = std::move(frame)]() mutable { party_->receive(std::move(frame)); });
  }
  /// Sends the body of a message unchanged.
  void send_raw(std::string body) { receive({rpc::MessageFrame::FramingError::None, std::move(body)}); }

  /// Waits for a message for which `fits` is true, and removes it from the received ones.
  Json wait_for(const std::function<bool(const Json&)>& fits) {
    static constexpr std::chrono::seconds kLongest{120};  // Longer than any answer takes, so that a hanging test fails.
    std::unique_lock lock(mutex_);
    Json found;
    const auto take = [&] {
      const auto message = std::find_if(messages_.begin(), messages_.end(), fits);
      if (message == messages_.end()) return false;
      found = std::move(*message);
      messages_.erase(message);
      return true;
    };
    if (!message_received_.wait_for(lock, kLongest, take)) throw std::runtime_error("no such message has come");
    return found;
  }
  /// Whether a received message that wait_for() has not returned fits.
  bool has(const std::function<bool(const Json&)>& fits) {
    const std::lock_guard lock(mutex_);
    return std::any_of(messages_.begin(), messages_.end(), fits);
  }

  bool is_speaking() const { return thread_.joinable(); }
  /// Disconnects without a message. Returns the exit status of the peer.
  int hang_up() {
    loop_.post([this] { party_->end(); });
    return wait_for_end();
  }
  /// Waits until the peer ends by itself. Returns its exit status.
  int wait_for_end() {
    thread_.join();
    return party_->exit_status();
  }

 private:
  void take(std::string body) {
    {
      const std::lock_guard lock(mutex_);
      messages_.push_back(Json::parse(body));
    }
    message_received_.notify_all();
  }

  rpc::Loop loop_;
  std::mutex mutex_;
  std::condition_variable message_received_;
  std::deque<Json> messages_;
  std::unique_ptr<rpc::Peer> party_;
  std::thread thread_;
};

}  // namespace isocnc::support
