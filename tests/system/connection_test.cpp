#include "interpreter/system/connection.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <future>
#include <memory>
#include <string>
#include <system_error>
#include <utility>
#include <variant>

namespace isocnc::system {
namespace {

using Accepted = std::variant<std::unique_ptr<Connection>, std::error_code>;

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

/// Both ends of a connection.
class Connections : public testing::Test {
 protected:
  Connections() {
    Listener listener;
    EXPECT_NE(listener.port(), 0);
    client = connected_to(listener.port());
    Accepted accepted = listener.accepted();
    if (auto* const connection = std::get_if<std::unique_ptr<Connection>>(&accepted)) server = std::move(*connection);
  }
  ~Connections() override { ::close(client); }
  void SetUp() override { ASSERT_TRUE(server); }

  int client = -1;
  std::unique_ptr<Connection> server;
};

TEST_F(Connections, CarryBytesBothWays) {
  ASSERT_EQ(::write(client, "question", 8), 8);
  char bytes[8] = {};
  ASSERT_EQ(server->read(bytes, sizeof bytes), 8u);
  EXPECT_EQ(std::string(bytes, 8), "question");
  EXPECT_TRUE(server->write("answer"));
  ASSERT_EQ(::read(client, bytes, sizeof bytes), 6);
  EXPECT_EQ(std::string(bytes, 6), "answer");
  server.reset();
  EXPECT_EQ(::read(client, bytes, sizeof bytes), 0);
}

TEST_F(Connections, ReadNothingMoreAfterTheirEnd) {
  char bytes[8] = {};
  auto read = std::async(std::launch::async, [&] { return server->read(bytes, sizeof bytes); });
  server->stop();
  EXPECT_EQ(read.get(), 0u);
}

TEST_F(Connections, GiveUpAClientThatReadsNothingAfterTheirEnd) {
  auto written = std::async(std::launch::async, [&] { return server->write(std::string(std::size_t{64} << 20, 'x')); });
  server->stop();
  EXPECT_FALSE(written.get());
}

TEST(AcceptOnLoopback, SaysWhenThePortBelongsToAnother) {
  Listener listener;
  const Accepted refused =
      accept_on_loopback(listener.port(), [](std::uint16_t) { ADD_FAILURE() << "the port is taken"; });
  ASSERT_TRUE(std::holds_alternative<std::error_code>(refused));
  EXPECT_EQ(std::get<std::error_code>(refused), std::errc::address_in_use);

  ::close(connected_to(listener.port()));
  EXPECT_TRUE(std::holds_alternative<std::unique_ptr<Connection>>(listener.accepted()));
}

}  // namespace
}  // namespace isocnc::system
