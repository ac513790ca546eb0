#include "interpreter/system/connection.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <optional>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "interpreter/system/descriptor.h"

namespace isocnc::system {

namespace {

/// The number of bytes that a pipe that is ready takes without blocking.
constexpr std::size_t kSurelyWritten = 4096;
/// How long the other side may take to read what was sent after stop().
constexpr int kPatienceMs = 1000;

/// A connection by descriptors; for a socket they are the same.
class PolledConnection final : public Connection {
 public:
  PolledConnection(int in, int out) : in_(in), out_(out) {
    int ends[2];
    if (::pipe(ends) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
    stopped_ = Descriptor(ends[0]);
    stop_ = Descriptor(ends[1]);
  }
  explicit PolledConnection(Descriptor socket) : PolledConnection(socket.number(), socket.number()) {
    socket_ = std::move(socket);
  }

  std::size_t read(char* bytes, std::size_t size) override {
    while (wait_for(in_, POLLIN, false)) {
      const std::ptrdiff_t count = read_some(in_, bytes, size);
      if (count < 0 && errno == EAGAIN) continue;
      return count < 0 ? 0 : static_cast<std::size_t>(count);
    }
    return 0;
  }

  bool write(std::string_view bytes) override {
    while (!bytes.empty())
      if (!wait_for(out_, POLLOUT, true) || !write_some_of(bytes)) return false;
    return true;
  }

  void stop() override { stop_ = Descriptor(); }

 private:
  /// Waits until the descriptor is ready. Returns false after stop(); with `is_patient`, only once the deadline has
  /// passed as well.
  bool wait_for(int descriptor, short events, bool is_patient) const;
  /// Writes what can be written without blocking. Returns false when the other side no longer reads.
  bool write_some_of(std::string_view& bytes) const;

  int in_;
  int out_;
  Descriptor socket_;
  Descriptor stopped_;  ///< A pipe that becomes readable when `stop_`, its other end, is closed.
  Descriptor stop_;
};

bool PolledConnection::wait_for(int descriptor, short events, bool is_patient) const {
  using Clock = std::chrono::steady_clock;
  std::array<pollfd, 2> polled{{{descriptor, events, 0}, {stopped_.number(), 0, 0}}};
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
    if (!is_patient) return false;
    deadline = Clock::now() + std::chrono::milliseconds(kPatienceMs);
  }
}

bool PolledConnection::write_some_of(std::string_view& bytes) const {
  ssize_t count = ::send(out_, bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
  if (count < 0 && errno == ENOTSOCK) count = ::write(out_, bytes.data(), std::min(bytes.size(), kSurelyWritten));
  if (count < 0) return errno == EINTR || errno == EAGAIN;
  bytes.remove_prefix(static_cast<std::size_t>(count));
  return true;
}

}  // namespace

std::unique_ptr<Connection> standard_connection() {
  return std::make_unique<PolledConnection>(kStandardInput, kStandardOutput);
}

std::variant<std::unique_ptr<Connection>, std::error_code> accept_on_loopback(
    std::uint16_t port, const std::function<void(std::uint16_t)>& on_port) {
  const auto failure = [] { return std::error_code(errno, std::generic_category()); };
  const Descriptor listener(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  if (!listener.is_open()) return failure();
  const int on = 1;
  ::setsockopt(listener.number(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  auto* const any = reinterpret_cast<sockaddr*>(&address);
  if (::bind(listener.number(), any, size) != 0 || ::listen(listener.number(), 1) != 0 ||
      ::getsockname(listener.number(), any, &size) != 0)
    return failure();
  on_port(ntohs(address.sin_port));
  Descriptor connection(::accept4(listener.number(), nullptr, nullptr, SOCK_CLOEXEC));
  if (!connection.is_open()) return failure();
  ::setsockopt(connection.number(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  return std::make_unique<PolledConnection>(std::move(connection));
}

}  // namespace isocnc::system
