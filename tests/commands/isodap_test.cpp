#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framed.h"
#include "run_command.h"
#include "tests/support/temporary_folder.h"

namespace isocnc::commands {
namespace {

using testing::HasSubstr;
using Json = nlohmann::json;

const std::string kInitializeDebugger =
    frame(R"({"seq":1,"type":"request","command":"initialize","arguments":{"adapterID":"isocnc"}})");
const std::string kConfigurationDone = frame(R"({"seq":3,"type":"request","command":"configurationDone"})");
const std::string kDisconnect = frame(R"({"seq":9,"type":"request","command":"disconnect"})");

std::string launch(const std::string& program) {
  const Json arguments = {{"program", program}, {"stopOnEntry", true}};
  return frame(Json{{"seq", 2}, {"type", "request"}, {"command", "launch"}, {"arguments", arguments}}.dump());
}

int isodap_status_after(const std::string& input) { return run_command({"isodap"}, {.input = input}).status; }

TEST(Isodap, EndsAsTheProtocolAsks) {
  EXPECT_EQ(isodap_status_after(kInitializeDebugger + kDisconnect), 0);
  EXPECT_EQ(isodap_status_after(kInitializeDebugger), 1);
  EXPECT_EQ(isodap_status_after(""), 1);
  EXPECT_EQ(isodap_status_after(kInitializeDebugger + "Content-Length: 100\r\n\r\n{"), 1);
}

TEST(Isodap, WritesAllThatItHasToSayBeforeItEnds) {
  const support::TemporaryFolder folder;
  const std::string program = folder.write("part.iso", "M06 T101001\nM02\n");
  const CommandResult result =
      run_command({"isodap"}, {.input = kInitializeDebugger + launch(program) + kConfigurationDone + kDisconnect});
  EXPECT_EQ(result.status, 0);
  int responses = 0;
  for (const Json& message : messages_of(result.out)) {
    if (message["type"] != "response") continue;
    EXPECT_TRUE(message["success"]) << message;
    ++responses;
  }
  EXPECT_EQ(responses, 4);
}

TEST(Isodap, SaysWhyAProgramCannotBeDebugged) {
  const CommandResult result = run_command({"isodap", "--lang", "it"},
                                           {.input = kInitializeDebugger + launch("/nowhere/part.iso") + kDisconnect});
  EXPECT_EQ(result.status, 0);
  std::string said;
  for (const Json& message : messages_of(result.out))
    if (message.value("command", "") == "launch") said = message.value("message", "");
  EXPECT_THAT(said, HasSubstr("/nowhere/part.iso"));
}

TEST(Isodap, DoesNotOutliveItsReader) {
  const CommandResult result = run_command(
      {"isodap"}, {.input = kInitializeDebugger + kDisconnect, .standard_output = StandardOutput::ClosedPipe});
  EXPECT_FALSE(result.timed_out);
  EXPECT_LT(result.status, 128);
}

TEST(Isodap, RefusesWhatItDoesNotKnow) {
  EXPECT_EQ(run_command({"isodap", "--server", "70000"}).status, 2);
  EXPECT_EQ(run_command({"isodap", "--server", "-1"}).status, 2);
  EXPECT_EQ(run_command({"isodap", "part.iso"}).status, 2);
  EXPECT_THAT(run_command({"isodap", "--sever", "0"}).err, HasSubstr("--server"));
  EXPECT_THAT(run_command({"isodap", "--version"}).out, HasSubstr("isodap "));
}

}  // namespace
}  // namespace isocnc::commands
