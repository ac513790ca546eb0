#pragma once

#include <cstdint>
#include <functional>
#include <system_error>
#include <variant>

namespace isocnc::lsp::rpc {

/// Waits for one client on a port of the loopback interface, where programs of this machine alone can come from. Gives
/// the connection's descriptor, or the errno of what went wrong. Port 0 takes any free one; `on_port` is told which.
std::variant<int, std::error_code> accept_on_loopback(std::uint16_t port,
                                                      const std::function<void(std::uint16_t)>& on_port);

}  // namespace isocnc::lsp::rpc
