#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framed.h"
#include "run_command.h"

namespace isocnc::commands {
namespace {

using testing::HasSubstr;
using Json = nlohmann::json;

const std::string kInitializeServer =
    frame(R"({"jsonrpc":"2.0","id":1,"method":"initialize","params":{"processId":null,"capabilities":{}}})");
const std::string kShutdown = frame(R"({"jsonrpc":"2.0","id":2,"method":"shutdown"})");
const std::string kExit = frame(R"({"jsonrpc":"2.0","method":"exit"})");

int isols_status_after(const std::string& input, const std::vector<std::string>& arguments = {"isols"}) {
  return run_command(arguments, {.input = input}).status;
}

TEST(Isols, EndsAsTheProtocolAsks) {
  EXPECT_EQ(isols_status_after(kInitializeServer + kShutdown + kExit), 0);
  EXPECT_EQ(isols_status_after(kInitializeServer + kShutdown + kExit, {"isols", "--stdio"}), 0);
  EXPECT_EQ(isols_status_after(kInitializeServer + kExit), 1);
  EXPECT_EQ(isols_status_after(kExit), 1);
  EXPECT_EQ(isols_status_after(kInitializeServer + kShutdown),
            0);  // The editor has disconnected without another message.
  EXPECT_EQ(isols_status_after(kInitializeServer), 1);
  EXPECT_EQ(isols_status_after(""), 1);
  EXPECT_EQ(isols_status_after(kInitializeServer + "Content-Length: 100\r\n\r\n{"), 1);
  EXPECT_EQ(isols_status_after("GET / HTTP/1.1\r\n\r\n"), 1);
}

TEST(Isols, WritesAllThatItHasToSayBeforeItEnds) {
  const std::string open = frame(
      R"({"jsonrpc":"2.0","method":"textDocument/didOpen","params":{"textDocument":{"uri":"untitled:a","version":1,)"
      R"("text":"G80\n"}}})");
  const std::string pull = frame(
      R"({"jsonrpc":"2.0","id":3,"method":"textDocument/diagnostic","params":{"textDocument":{"uri":"untitled:a"}}})");
  const CommandResult result =
      run_command({"isols"}, {.input = kInitializeServer + "no header\n\n" + open + pull + kShutdown});
  const std::vector<Json> messages = messages_of(result.out);
  ASSERT_GE(messages.size(), 3u);
  EXPECT_EQ(messages[0]["result"]["serverInfo"]["name"], "isols");
  EXPECT_EQ(messages[1]["error"]["code"], -32700);
}

TEST(Isols, DoesNotOutliveItsReader) {
  const CommandResult result = run_command(
      {"isols"}, {.input = kInitializeServer + kShutdown + kExit, .standard_output = StandardOutput::ClosedPipe});
  EXPECT_FALSE(result.timed_out);
  EXPECT_LT(result.status, 128);
}

TEST(Isols, RefusesWhatItDoesNotKnow) {
  EXPECT_EQ(run_command({"isols", "--tcp", "70000"}).status, 2);
  EXPECT_EQ(run_command({"isols", "--tcp", "-1"}).status, 2);
  EXPECT_EQ(run_command({"isols", "--tcp", "0", "--stdio"}).status, 2);
  EXPECT_EQ(run_command({"isols", "part.iso"}).status, 2);
  EXPECT_THAT(run_command({"isols", "--version"}).out, HasSubstr("isols "));
}

}  // namespace
}  // namespace isocnc::commands
