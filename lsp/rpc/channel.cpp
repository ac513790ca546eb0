#include "lsp/rpc/channel.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace isocnc::rpc {

/// The number of unsent bytes from which we stop reading from the other side.
static constexpr std::size_t kMaxUnsent = std::size_t{64} << 20;
/// The number of bytes that a pipe that is ready takes without blocking.
static constexpr std::size_t kSurelyWritten = 4096;
/// How long the other side may take to read what was sent when the channel ends.
static constexpr int kPatienceMs = 1000;

Channel::Channel(Descriptors descriptors, Events events) : descriptors_(descriptors), events_(std::move(events)) {
  if (::pipe(stop_pipe_) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
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
  ::close(stop_pipe_[1]);
  for (std::thread* const thread : {&reader_, &writer_})
    if (thread->joinable()) thread->join();
  ::close(stop_pipe_[0]);
}

/// Waits until the descriptor is ready. Returns false when the channel has to end; with `until_deadline`, only once the
/// deadline has passed as well.
bool Channel::wait_for(int descriptor, short events, bool until_deadline) const {
  using Clock = std::chrono::steady_clock;
  std::array<pollfd, 2> polled{{{descriptor, events, 0}, {stop_pipe_[0], 0, 0}}};
  std::optional<Clock::time_point> deadline;
  for (;;) {
    int timeout = -1;
    if (deadline) {
      timeout =
          static_cast<int>(std::chrono::duration_cast<std::chrono::milliseconds>(*deadline - Clock::now()).count());
      if (timeout <= 0) return false;
    }
    const int ready = ::poll(polled.data(), deadline ? 1 : 2, timeout);
    if (ready < 0 && errno != EINTR) return false;
    if (ready <= 0) continue;
    if (polled[0].revents != 0) return true;
    if (!until_deadline) return false;
    deadline = Clock::now() + std::chrono::milliseconds(kPatienceMs);
  }
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
  while (may_read() && wait_for(descriptors_.in, POLLIN, false)) {
    const ssize_t count = ::read(descriptors_.in, buffer.data(), buffer.size());
    if (count < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (count <= 0) break;
    reader.read({buffer.data(), static_cast<std::size_t>(count)}, frames);
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
      for (unsent_.pop_front(); !unsent_.empty() && text.size() + unsent_.front().size() <= kSurelyWritten;
           unsent_.pop_front())
        text += unsent_.front();
    }
    std::string_view rest = text;
    while (!rest.empty() && wait_for(descriptors_.out, POLLOUT, true) && write_some(rest)) {
    }
    {
      const std::lock_guard lock(mutex_);
      unsent_bytes_ -= text.size();
      is_broken_ = !rest.empty();
      if (is_broken_) unsent_.clear();
    }
    changed_.notify_all();
    if (rest.empty()) continue;
    events_.end();
    return;
  }
}

/// Writes what can be written without blocking. Returns false when the other side no longer reads.
bool Channel::write_some(std::string_view& bytes) const {
  ssize_t count = ::send(descriptors_.out, bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
  if (count < 0 && errno == ENOTSOCK)
    count = ::write(descriptors_.out, bytes.data(), std::min(bytes.size(), kSurelyWritten));
  if (count < 0) return errno == EINTR || errno == EAGAIN;
  bytes.remove_prefix(static_cast<std::size_t>(count));
  return true;
}

}  // namespace isocnc::rpc
