#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>
#include <system_error>
#include <variant>

namespace isocnc::system {

/// The bytes that go to one client and come from it. One thread reads, one writes, and any may stop both.
class Connection {
 public:
  Connection() = default;
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;
  virtual ~Connection() = default;

  /// Waits for bytes and takes at most `size` of them. Returns their number: 0 when nothing more comes, or after
  /// stop().
  virtual std::size_t read(char* bytes, std::size_t size) = 0;
  /// Writes all bytes. Returns false when the client no longer reads them; after stop(), when it has read none for a
  /// second.
  virtual bool write(std::string_view bytes) = 0;
  /// Ends the waiting of the other threads.
  virtual void stop() = 0;
};

/// The client at standard input and output. Throws std::system_error.
std::unique_ptr<Connection> standard_connection();

/// Waits for one client on a port of the loopback interface, which only programs on this machine can reach. Returns the
/// connection, or why there is none. Port 0 takes any free port; `on_port` gets its number. Throws std::system_error.
std::variant<std::unique_ptr<Connection>, std::error_code> accept_on_loopback(
    std::uint16_t port, const std::function<void(std::uint16_t)>& on_port);

}  // namespace isocnc::system
