#include "lsp/rpc/channel.h"

#include <utility>

namespace isocnc::rpc {

/// The number of unsent bytes from which we stop reading from the other side.
static constexpr std::size_t kMaxUnsent = std::size_t{64} << 20;
/// The number of bytes of short messages that are written together.
static constexpr std::size_t kShort = 4096;

Channel::Channel(std::unique_ptr<system::Connection> connection, Events events)
    : connection_(std::move(connection)), events_(std::move(events)) {
  try {
    reader_ = std::thread([this] { read_all(); });
    writer_ = std::thread([this] { write_all(); });
  } catch (...) {  // Also bad_alloc: a thread that runs must be joined.
    end();
    throw;
  }
}

Channel::~Channel() { end(); }

void Channel::end() {
  {
    const std::lock_guard lock(mutex_);
    is_ending_ = true;
  }
  changed_.notify_all();
  connection_->stop();
  for (std::thread* const thread : {&reader_, &writer_})
    if (thread->joinable()) thread->join();
}

/// Waits while too much is unsent. Returns false when the channel has to end.
bool Channel::may_read() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return is_ending_ || is_broken_ || unsent_bytes_ < kMaxUnsent; });
  return !is_ending_ && !is_broken_;
}

void Channel::read_all() {
  FrameReader reader;
  std::deque<MessageFrame> frames;
  std::string buffer(std::size_t{256} << 10, '\0');
  while (may_read()) {
    const std::size_t count = connection_->read(buffer.data(), buffer.size());
    if (count == 0) break;
    reader.read({buffer.data(), count}, frames);
    for (; !frames.empty(); frames.pop_front()) events_.frame(std::move(frames.front()));
  }
  events_.end();
}

void Channel::send(std::string body) {
  std::string header = frame_header(body.size());
  {
    const std::lock_guard lock(mutex_);
    if (is_broken_) return;
    unsent_bytes_ += header.size() + body.size();
    unsent_.push_back(std::move(header));
    unsent_.push_back(std::move(body));
  }
  changed_.notify_all();
}

void Channel::write_all() {
  for (;;) {
    std::string text;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return is_ending_ || !unsent_.empty(); });
      if (unsent_.empty()) return;
      // Short messages are written together.
      text = std::move(unsent_.front());
      for (unsent_.pop_front(); !unsent_.empty() && text.size() + unsent_.front().size() <= kShort; unsent_.pop_front())
        text += unsent_.front();
    }
    const bool is_written = connection_->write(text);
    {
      const std::lock_guard lock(mutex_);
      unsent_bytes_ -= text.size();
      is_broken_ = !is_written;
      if (is_broken_) unsent_.clear();
    }
    changed_.notify_all();
    if (is_written) continue;
    events_.end();
    return;
  }
}

}  // namespace isocnc::rpc
