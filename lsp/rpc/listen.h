#pragma once

#include <cstdint>
#include <functional>
#include <system_error>
#include <variant>

namespace isocnc::rpc {

/// Waits for one client on a port of the loopback interface, which only programs on this machine can reach. Returns the
/// descriptor of the connection, or the errno of the failure. Port 0 takes any free port; `on_port` gets its number.
std::variant<int, std::error_code> accept_on_loopback(std::uint16_t port,
                                                      const std::function<void(std::uint16_t)>& on_port);

}  // namespace isocnc::rpc
