#include "lsp/rpc/listen.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <future>
#include <string>
#include <system_error>
#include <variant>

namespace isocnc::rpc {
namespace {

using Accepted = std::variant<int, std::error_code>;

/// Waits for a client on a free port, in parallel to the test.
class Listener {
 public:
  Listener() : port_(port_promise_.get_future().get()) {}

  std::uint16_t port() const { return port_; }
  Accepted accepted() { return accepted_.get(); }

 private:
  Accepted accept() {
    return accept_on_loopback(0, [this](std::uint16_t port) { port_promise_.set_value(port); });
  }

  std::promise<std::uint16_t> port_promise_;
  std::future<Accepted> accepted_ = std::async(std::launch::async, &Listener::accept, this);
  std::uint16_t port_;
};

/// A connection of this process to a port of the loopback interface.
int connected_to(std::uint16_t port) {
  const int client = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  EXPECT_EQ(::connect(client, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  return client;
}

TEST(AcceptOnLoopback, GivesTheConnectionOfTheFirstClient) {
  Listener listener;
  EXPECT_NE(listener.port(), 0);
  const int client = connected_to(listener.port());
  const Accepted result = listener.accepted();
  ASSERT_TRUE(std::holds_alternative<int>(result));
  const int server = std::get<int>(result);

  ASSERT_EQ(::write(client, "question", 8), 8);
  char bytes[8] = {};
  ASSERT_EQ(::read(server, bytes, sizeof bytes), 8);
  EXPECT_EQ(std::string(bytes, 8), "question");
  ::close(server);
  EXPECT_EQ(::read(client, bytes, sizeof bytes), 0);
  ::close(client);
}

TEST(AcceptOnLoopback, SaysWhenThePortBelongsToAnother) {
  Listener listener;
  const Accepted refused =
      accept_on_loopback(listener.port(), [](std::uint16_t) { ADD_FAILURE() << "the port is taken"; });
  ASSERT_TRUE(std::holds_alternative<std::error_code>(refused));
  EXPECT_EQ(std::get<std::error_code>(refused), std::errc::address_in_use);

  ::close(connected_to(listener.port()));
  ::close(std::get<int>(listener.accepted()));
}

}  // namespace
}  // namespace isocnc::rpc
