#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <string>
#include <utility>

#include "run_command.h"

namespace isocnc::commands {
namespace {

/// A port of the loopback interface that belongs to this process.
class TakenPort {
 public:
  TakenPort() {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* const any = reinterpret_cast<sockaddr*>(&address);
    EXPECT_EQ(::bind(socket_, any, size), 0);
    EXPECT_EQ(::listen(socket_, 1), 0);
    EXPECT_EQ(::getsockname(socket_, any, &size), 0);
    number_ = ntohs(address.sin_port);
  }
  TakenPort(const TakenPort&) = delete;
  TakenPort& operator=(const TakenPort&) = delete;
  ~TakenPort() { ::close(socket_); }

  std::string number() const { return std::to_string(number_); }

 private:
  const int socket_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  std::uint16_t number_ = 0;
};

TEST(Port, ThatBelongsToAnotherEndsTheProgramWithTheReason) {
  const TakenPort port;
  for (const auto& [program, option] : {std::pair("isols", "--tcp"), std::pair("isodap", "--server")}) {
    const CommandResult result = run_command({program, option, port.number()});
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(result.err, std::string(program) + ": 127.0.0.1:" + port.number() + ": Address already in use\n");
  }
}

}  // namespace
}  // namespace isocnc::commands
