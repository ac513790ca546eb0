#include "interpreter/system/connection.h"

#include <winsock2.h>

#include <windows.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "interpreter/system/windows/errors.h"

namespace isocnc::system {

namespace {

using Clock = std::chrono::steady_clock;

/// How long the other side may take to read what was sent after stop().
constexpr std::chrono::seconds kPatience{1};
/// What one call reads or writes at most: its counts are of 32 bits.
constexpr std::size_t kLargestPiece = std::size_t{1} << 20;

/// What a client has sent and we have not taken, or the other way round. Shared with a thread that may wait for the
/// system longer than we do: Windows lets nobody wait for a pipe together with anything else.
struct Transfer {
  std::mutex mutex;  ///< Guards the members below.
  std::condition_variable changed;
  std::string bytes;
  std::size_t taken = 0;      ///< How many of them have been taken.
  std::uint64_t moved = 0;    ///< How many have gone through since the beginning.
  bool is_over = false;       ///< Nothing more goes through.
  bool is_stopped = false;    ///< We no longer wait for the client.
  bool is_abandoned = false;  ///< We have left: no further call of the system begins.
  bool is_calling = false;    ///< The thread is in a call of the system.

  std::string_view rest() const { return std::string_view(bytes).substr(taken); }
  void take(std::size_t count) {
    taken += count;
    moved += count;
    if (taken < bytes.size()) return;
    bytes.clear();
    taken = 0;
  }
  template <class Call>
  bool call(std::unique_lock<std::mutex>& lock, const Call& function) {
    is_calling = true;
    lock.unlock();
    const bool is_good = function();
    lock.lock();
    is_calling = false;
    return is_good;
  }
};

/// Takes bytes from a file until it ends.
void receive(HANDLE file, Transfer& transfer) {
  constexpr std::size_t kAhead = std::size_t{1} << 20;
  std::string piece(std::size_t{64} << 10, '\0');
  std::unique_lock lock(transfer.mutex);
  while (!transfer.is_over && !transfer.is_abandoned) {
    DWORD count = 0;
    const bool is_read = transfer.call(
        lock, [&] { return ::ReadFile(file, piece.data(), static_cast<DWORD>(piece.size()), &count, nullptr) != 0; });
    transfer.bytes.append(piece, 0, count);
    transfer.is_over = !is_read || count == 0;
    transfer.changed.notify_all();
    transfer.changed.wait(lock, [&] { return transfer.rest().size() < kAhead || transfer.is_abandoned; });
  }
}

/// Gives bytes to a file until it takes no more.
void deliver(HANDLE file, Transfer& transfer) {
  std::unique_lock lock(transfer.mutex);
  for (;;) {
    transfer.changed.wait(lock, [&] { return !transfer.bytes.empty() || transfer.is_abandoned; });
    if (transfer.is_abandoned) return;
    // In small pieces, so that one that takes long is one that nobody reads.
    const std::string piece(transfer.rest().substr(0, 4096));
    DWORD count = 0;
    const bool is_written = transfer.call(
        lock, [&] { return ::WriteFile(file, piece.data(), static_cast<DWORD>(piece.size()), &count, nullptr) != 0; });
    transfer.take(count);
    transfer.is_over = !is_written;
    transfer.changed.notify_all();
    if (transfer.is_over) return;
  }
}

/// Standard input and output.
class PipeConnection final : public Connection {
 public:
  PipeConnection()
      : receiver_([from = in_] { receive(::GetStdHandle(STD_INPUT_HANDLE), *from); }),
        deliverer_([to = out_] { deliver(::GetStdHandle(STD_OUTPUT_HANDLE), *to); }) {}
  ~PipeConnection() override {
    set(&Transfer::is_abandoned);
    leave(*in_, receiver_);
    leave(*out_, deliverer_);
  }

  std::size_t read(char* bytes, std::size_t size) override {
    std::unique_lock lock(in_->mutex);
    in_->changed.wait(lock, [&] { return !in_->bytes.empty() || in_->is_over || in_->is_stopped; });
    if (in_->is_stopped) return 0;
    const std::size_t count = in_->rest().copy(bytes, size);
    in_->take(count);
    in_->changed.notify_all();
    return count;
  }

  bool write(std::string_view bytes) override {
    std::unique_lock lock(out_->mutex);
    out_->bytes += bytes;
    out_->changed.notify_all();
    while (!out_->bytes.empty() && !out_->is_over) {
      const std::uint64_t moved = out_->moved;
      const auto goes_on = [&] { return out_->moved != moved || out_->is_over; };
      out_->changed.wait(lock, [&] { return goes_on() || out_->is_stopped; });
      if (!goes_on() && !out_->changed.wait_for(lock, kPatience, goes_on)) return false;
    }
    return !out_->is_over;
  }

  void stop() override { set(&Transfer::is_stopped); }

 private:
  void set(bool Transfer::*flag) {
    for (const auto& each : {in_, out_}) {
      const std::lock_guard lock(each->mutex);
      (*each).*flag = true;
      each->changed.notify_all();
    }
  }

  /// A thread that the system keeps is left to the end of the process.
  static void leave(Transfer& transfer, std::thread& thread) {
    std::unique_lock lock(transfer.mutex);
    if (transfer.is_calling) return thread.detach();
    lock.unlock();
    thread.join();
  }

  const std::shared_ptr<Transfer> in_ = std::make_shared<Transfer>();
  const std::shared_ptr<Transfer> out_ = std::make_shared<Transfer>();
  std::thread receiver_;
  std::thread deliverer_;
};

std::error_code code_of(int error) { return {errno_of(static_cast<unsigned long>(error)), std::generic_category()}; }
std::error_code last_socket_error() { return code_of(::WSAGetLastError()); }

/// A socket that the destructor closes.
class Socket {
 public:
  explicit Socket(SOCKET socket) : socket_(socket) {}
  Socket(Socket&& other) noexcept : socket_(std::exchange(other.socket_, INVALID_SOCKET)) {}
  Socket& operator=(Socket&&) = delete;
  ~Socket() {
    if (is_open()) ::closesocket(socket_);
  }

  bool is_open() const { return socket_ != INVALID_SOCKET; }
  SOCKET get() const { return socket_; }

 private:
  SOCKET socket_;
};

/// A client at a port. Asks now and then whether it has been stopped.
class SocketConnection final : public Connection {
 public:
  explicit SocketConnection(Socket socket) : socket_(std::move(socket)) {
    u_long on = 1;
    ::ioctlsocket(socket_.get(), FIONBIO, &on);
  }

  std::size_t read(char* bytes, std::size_t size) override {
    while (wait_for(POLLRDNORM, false)) {
      const int count = ::recv(socket_.get(), bytes, static_cast<int>(std::min(size, kLargestPiece)), 0);
      if (count == SOCKET_ERROR && ::WSAGetLastError() == WSAEWOULDBLOCK) continue;
      return count < 0 ? 0 : static_cast<std::size_t>(count);
    }
    return 0;
  }

  bool write(std::string_view bytes) override {
    while (!bytes.empty()) {
      if (!wait_for(POLLWRNORM, true)) return false;
      const int count = ::send(socket_.get(), bytes.data(), static_cast<int>(std::min(bytes.size(), kLargestPiece)), 0);
      if (count == SOCKET_ERROR && ::WSAGetLastError() == WSAEWOULDBLOCK) continue;
      if (count < 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return true;
  }

  void stop() override { is_stopped_ = true; }

 private:
  /// Waits until the socket is ready. Returns false after stop(); with `is_patient`, only once the deadline has passed
  /// as well.
  bool wait_for(short events, bool is_patient) const {
    constexpr int kPaceMs = 50;
    std::optional<Clock::time_point> deadline;
    for (;;) {
      WSAPOLLFD polled{socket_.get(), events, 0};
      const int ready = ::WSAPoll(&polled, 1, kPaceMs);
      if (ready != 0) return ready > 0;
      if (!is_stopped_) continue;
      if (!is_patient) return false;
      if (!deadline) deadline = Clock::now() + kPatience;
      if (Clock::now() > *deadline) return false;
    }
  }

  Socket socket_;
  std::atomic<bool> is_stopped_ = false;
};

}  // namespace

std::unique_ptr<Connection> standard_connection() { return std::make_unique<PipeConnection>(); }

std::variant<std::unique_ptr<Connection>, std::error_code> accept_on_loopback(
    std::uint16_t port, const std::function<void(std::uint16_t)>& on_port) {
  WSADATA data{};
  if (const int error = ::WSAStartup(MAKEWORD(2, 2), &data)) return code_of(error);
  const Socket listener(::socket(AF_INET, SOCK_STREAM, 0));
  if (!listener.is_open()) return last_socket_error();
  const BOOL on = TRUE;
  // Else another program could take the port as well.
  ::setsockopt(listener.get(), SOL_SOCKET, SO_EXCLUSIVEADDRUSE, reinterpret_cast<const char*>(&on), sizeof on);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = ::htons(port);
  address.sin_addr.s_addr = ::htonl(INADDR_LOOPBACK);
  int size = sizeof address;
  auto* const any = reinterpret_cast<sockaddr*>(&address);
  if (::bind(listener.get(), any, size) != 0 || ::listen(listener.get(), 1) != 0 ||
      ::getsockname(listener.get(), any, &size) != 0)
    return last_socket_error();
  on_port(::ntohs(address.sin_port));
  Socket client(::accept(listener.get(), nullptr, nullptr));
  if (!client.is_open()) return last_socket_error();
  ::setsockopt(client.get(), IPPROTO_TCP, TCP_NODELAY, reinterpret_cast<const char*>(&on), sizeof on);
  return std::make_unique<SocketConnection>(std::move(client));
}

}  // namespace isocnc::system
