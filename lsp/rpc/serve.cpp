#include "lsp/rpc/serve.h"

#include <chrono>
#include <cstdlib>
#include <system_error>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "interpreter/system/connection.h"
#include "interpreter/system/process.h"
#include "interpreter/system/system_texts.h"
#include "lsp/rpc/channel.h"

namespace isocnc::rpc {

/// The time without a message after which the peer may check whether the client still exists.
static constexpr std::chrono::seconds kIdleInterval{3};

[[noreturn]] static void run_peer(std::unique_ptr<system::Connection> connection, const MakePeer& make_peer) {
  system::share_one_heap();
  Loop loop;
  Channel* open_channel = nullptr;
  const std::unique_ptr<Peer> peer = make_peer(loop, [&](std::string body) { open_channel->send(std::move(body)); });
  {
    Channel channel(std::move(connection),
                    {.frame =
                         [&](MessageFrame frame) {
                           loop.post([&, frame = std::move(frame)]() mutable { peer->receive(std::move(frame)); });
                         },
                     .end = [&] { loop.post([&] { peer->end(); }); }});
    open_channel = &channel;
    loop.run(kIdleInterval, [&] { peer->idle(); });
  }
  // Unfinished work was for a client that has left, so it is not waited for.
  std::_Exit(peer->exit_status());
}

void serve(const std::optional<std::uint16_t>& port, dialect::Language language, const MakePeer& make_peer,
           const std::function<void(const std::string&)>& report) {
  if (!port) run_peer(system::standard_connection(), make_peer);
  const auto address = [](std::uint16_t number) { return fmt::format("127.0.0.1:{}", number); };
  auto accepted = system::accept_on_loopback(*port, [&](std::uint16_t number) { report(address(number)); });
  if (const auto* const error = std::get_if<std::error_code>(&accepted))
    return report(fmt::format("{}: {}", address(*port), system::reason_of(error->value(), language)));
  run_peer(std::move(std::get<std::unique_ptr<system::Connection>>(accepted)), make_peer);
}

}  // namespace isocnc::rpc
