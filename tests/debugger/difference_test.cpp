#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "debug_client.h"
#include "programs.h"

/// isocnc/runToDifference: to where the program does something else than another one.
namespace isocnc::debugger {
namespace {

using testing::HasSubstr;

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

/// As kPart, but its first motions, on lines 7 and 8, end elsewhere, and its lines have other numbers.
const std::string kOld = "; the part before\n\n\n" + replaced(kPart, "G00 X10 Y5", "G00 X8 Y5");

TEST(Difference, RunsForwardToItAndSaysWhatItIs) {
  DebugClient client;
  client.write("old.iso", kOld);
  client.stop_at_start(kPart);
  const Json stopped = client.run("isocnc/runToDifference", {{"path", "old.iso"}});
  EXPECT_TRUE(client.has_event("continued")) << "the client does not know that the program has run";
  EXPECT_EQ(stopped.at("reason"), "difference");
  EXPECT_EQ(stopped.at("description"), "first difference: moved by X2, lines 10-11 of old.iso");
  EXPECT_EQ(client.line(), 7);
  EXPECT_EQ(client.evaluate("T"), "101001");
  EXPECT_EQ(client.evaluate("XM"), "0");
  client.run("next");
  EXPECT_EQ(client.evaluate("X"), "10");
}

TEST(Difference, RunsBackToItWithTheStateOfARunToIt) {
  DebugClient client;
  client.write("old.iso", kOld);
  client.stop_at_start(kPart);
  client.run("isocnc/runToDifference", {{"path", "old.iso"}});
  const std::string forward = client.state();
  client.run("goto", {{"threadId", 1}, {"targetId", 17}});
  EXPECT_EQ(client.line(), 18);
  const Json stopped = client.run("isocnc/runToDifference", {{"path", "old.iso"}});
  EXPECT_EQ(stopped.at("reason"), "difference");
  EXPECT_EQ(client.line(), 7);
  EXPECT_EQ(client.state(), forward);
}

TEST(Difference, OfWhatIsNoLongerDoneIsBeforeTheNextBlock) {
  DebugClient client;
  client.stop_at_start(kPart);
  const std::string old = replaced(kPart, "G03 X40", "X60 Y5\nX40 Y5\nG03 X40");
  const Json stopped = client.run("isocnc/runToDifference", {{"text", old}, {"name", "HEAD"}});
  EXPECT_THAT(stopped.at("description").get<std::string>(), HasSubstr("lines 11-12 of HEAD"));
  EXPECT_EQ(client.line(), 11);
}

TEST(Difference, OfWhatIsNewNamesWhereTheOtherProgramIs) {
  DebugClient client;
  client.stop_at_start(kPart);
  const std::string old = replaced(kPart, "M100 P1=2.5 P2=8\n", "");
  const Json stopped = client.run("isocnc/runToDifference", {{"text", old}, {"name", "HEAD"}});
  EXPECT_EQ(stopped.at("description"), "first difference: added: M100 P1=2.5 P2=8, before line 17 of HEAD");
  EXPECT_EQ(client.line(), 17);
}

TEST(Difference, StaysWhereThereIsNone) {
  DebugClient client;
  client.stop_at_start(kPart);
  client.run("next");
  const std::string before = client.state();
  const Json stopped = client.run("isocnc/runToDifference", {{"text", "\n" + kPart}, {"name", "HEAD"}});
  EXPECT_EQ(stopped.at("reason"), "difference");
  EXPECT_EQ(stopped.at("description"), "no difference from HEAD in what the machine does");
  EXPECT_EQ(client.event("output").at("output"), "no difference from HEAD in what the machine does\n");
  EXPECT_EQ(client.state(), before);
}

TEST(Difference, BothRunAsLaunched) {
  DebugClient client;
  // With VGPL 5, the IF jumps in both over what differs.
  const std::string text = "M06 T101001\nIF VGPL = 5 GOTO N10\nG01 X10 F1000\nN10 G00 Z50\nM02\n";
  client.stop_at_start(text, {{"vgpl", 5}});
  const std::string old = replaced(text, "X10", "X11");
  EXPECT_THAT(client.run("isocnc/runToDifference", {{"text", old}}).at("description").get<std::string>(),
              HasSubstr("no difference"));
  DebugClient other;
  other.stop_at_start(text);
  EXPECT_THAT(other.run("isocnc/runToDifference", {{"text", old}}).at("description").get<std::string>(),
              HasSubstr("moved by X-1"));
}

TEST(Difference, EachFileHasTheMachineAboveIt) {
  DebugClient client;
  const std::string text = "M06 T101001\nG00 X10\nM02\n";
  client.write("isocnc.json", R"({"machine": {"home": {"z": 100}}})");
  client.write("other/isocnc.json", R"({"machine": {"home": {"z": 200}}})");
  client.write("old.iso", text);
  client.write("other/old.iso", text);
  client.stop_at_start(text);
  EXPECT_THAT(client.run("isocnc/runToDifference", {{"path", "old.iso"}}).at("description").get<std::string>(),
              HasSubstr("no difference"));
  EXPECT_THAT(client.run("isocnc/runToDifference", {{"path", "other/old.iso"}}).at("description").get<std::string>(),
              HasSubstr("first difference"));
}

TEST(Difference, RefusesWhatItCannotRead) {
  DebugClient client;
  client.stop_at_start(kPart);
  EXPECT_THAT(client.refusal("isocnc/runToDifference", {{"path", "none.iso"}}), HasSubstr("none.iso: "));
  EXPECT_THAT(client.refusal("isocnc/runToDifference"), HasSubstr("path has to name the file"));
  EXPECT_EQ(client.line(), 2);
}

TEST(Difference, StaysWhereTheOtherProgramDoesNotRunToItsEnd) {
  DebugClient client;
  client.stop_at_start(kPart);
  const Json stopped = client.run("isocnc/runToDifference", {{"text", kWrong}, {"name", "wrong.iso"}});
  EXPECT_EQ(stopped.at("description"), "wrong.iso cannot be compared: it stops at its line 4 with ISO028");
  EXPECT_EQ(client.event("output").at("category"), "important");
  EXPECT_EQ(client.line(), 2);
}

TEST(Difference, WhereTheProgramEndsWithAnErrorIsOne) {
  DebugClient client;
  client.stop_at_start(kWrong);
  const std::string old = replaced(kWrong, "G02 X20\n", "");
  const Json stopped = client.run("isocnc/runToDifference", {{"text", old}, {"name", "old.iso"}});
  EXPECT_EQ(stopped.at("description"), "first difference: ends with ISO028 instead of M02, line 4 of old.iso");
  EXPECT_EQ(client.line(), 4);
}

TEST(Difference, IsACommandOfTheConsole) {
  DebugClient client;
  client.write("old part.iso", kOld);
  client.stop_at_start(kPart);
  EXPECT_EQ(client.evaluate("difference old part.iso", "repl"), "comparing with old part.iso");
  EXPECT_EQ(client.event("stopped").at("description"), "first difference: moved by X2, lines 10-11 of old part.iso");
  EXPECT_EQ(client.line(), 7);
  EXPECT_THAT(client.refusal("evaluate", {{"expression", "difference none.iso"}, {"context", "repl"}}),
              HasSubstr("none.iso: "));
}

TEST(Difference, APauseEndsTheComparison) {
  std::string text = "M06 T101001\nG01 X0 F1000\n";
  for (int i = 0; i < 300000; ++i) text += "X" + std::to_string(i % 100) + " Y" + std::to_string(i % 97) + "\n";
  text += "M02\n";
  DebugClient client;
  client.stop_at_start(text);
  client.request("isocnc/runToDifference", {{"text", text}});
  EXPECT_THAT(client.refusal("next"), HasSubstr("pause"));
  EXPECT_EQ(client.run("pause").at("reason"), "pause");
  EXPECT_EQ(client.line(), 1);
  EXPECT_FALSE(client.has_event("stopped"));
}

}  // namespace
}  // namespace isocnc::debugger
