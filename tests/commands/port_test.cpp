#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "framed.h"
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

/// All that a server says to these messages, over a port of its choice, until it ends; `status` is what it ends with.
std::string replies_over_port(const std::string& program, const std::string& option, const std::string& messages,
                              int& status) {
  FILE* const pipe = ::popen((ISOCNC_BIN_DIR "/" + program + " " + option + " 0 2>&1 </dev/null").c_str(), "r");
  char line[200] = {};
  unsigned port = 0;
  if (std::fgets(line, sizeof line, pipe) == nullptr ||
      std::sscanf(line, (program + ": 127.0.0.1:%u").c_str(), &port) != 1)
    ADD_FAILURE() << line;
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const int client = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  std::string said;
  if (::connect(client, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0 &&
      ::write(client, messages.data(), messages.size()) == static_cast<ssize_t>(messages.size())) {
    char bytes[4096];
    for (ssize_t count; (count = ::read(client, bytes, sizeof bytes)) > 0;)
      said.append(bytes, static_cast<std::size_t>(count));
  }
  ::close(client);
  status = WEXITSTATUS(::pclose(pipe));
  return said;
}

TEST(Port, ServesItsClientUntilItLeaves) {
  int status = -1;
  const std::vector<nlohmann::json> from_isols = messages_of(replies_over_port(
      "isols", "--tcp",
      frame(R"({"jsonrpc":"2.0","id":1,"method":"initialize","params":{"capabilities":{}}})") +
          frame(R"({"jsonrpc":"2.0","id":2,"method":"shutdown"})") + frame(R"({"jsonrpc":"2.0","method":"exit"})"),
      status));
  EXPECT_EQ(status, 0);
  ASSERT_EQ(from_isols.size(), 2u);
  EXPECT_EQ(from_isols[0]["result"]["serverInfo"]["name"], "isols");
  const std::vector<nlohmann::json> from_isodap = messages_of(replies_over_port(
      "isodap", "--server",
      frame(R"({"seq":1,"type":"request","command":"initialize","arguments":{"adapterID":"isocnc"}})") +
          frame(R"({"seq":2,"type":"request","command":"disconnect"})"),
      status));
  EXPECT_EQ(status, 0);
  ASSERT_GE(from_isodap.size(), 2u);
  EXPECT_EQ(from_isodap[0]["body"]["supportsStepBack"], true);
}

}  // namespace
}  // namespace isocnc::commands
