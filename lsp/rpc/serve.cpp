#include "lsp/rpc/serve.h"

#include <chrono>
#include <cstdlib>
#include <system_error>
#include <utility>
#include <variant>

#include <malloc.h>
#include <unistd.h>

#include <fmt/format.h>

#include "lsp/rpc/channel.h"
#include "lsp/rpc/listen.h"

namespace isocnc::rpc {

/// The time without a message after which the peer may check whether the client still exists.
static constexpr std::chrono::seconds kIdleInterval{3};

/// All threads share one heap, which grows in large steps: with a heap per thread the system would be asked for every
/// page again, a tenth of the time that opening a long program takes. Messages, which may have some hundred kilobytes
/// after each edit, lie in this heap for the same reason; the text of a long program does not.
static void prepare_heap() {
#ifdef __GLIBC__
  // NOLINTBEGIN(concurrency-mt-unsafe): there is one thread yet.
  mallopt(M_ARENA_MAX, 1);
  mallopt(M_TOP_PAD, 8 << 20);
  mallopt(M_TRIM_THRESHOLD, 16 << 20);
  mallopt(M_MMAP_THRESHOLD, 4 << 20);
  // NOLINTEND(concurrency-mt-unsafe)
#endif
}

[[noreturn]] static void run_peer(Descriptors descriptors, const MakePeer& make_peer) {
  prepare_heap();
  Loop loop;
  Channel* open_channel = nullptr;
  const std::unique_ptr<Peer> peer = make_peer(loop, [&](std::string body) { open_channel->send(std::move(body)); });
  {
    Channel channel(descriptors,
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

void serve(const std::optional<std::uint16_t>& port, const MakePeer& make_peer,
           const std::function<void(const std::string&)>& report) {
  if (!port) run_peer({STDIN_FILENO, STDOUT_FILENO}, make_peer);
  const auto address = [](std::uint16_t number) { return fmt::format("127.0.0.1:{}", number); };
  const auto accepted = accept_on_loopback(*port, [&](std::uint16_t number) { report(address(number)); });
  if (const auto* const error = std::get_if<std::error_code>(&accepted))
    return report(fmt::format("{}: {}", address(*port), error->message()));
  run_peer({std::get<int>(accepted), std::get<int>(accepted)}, make_peer);
}

}  // namespace isocnc::rpc
