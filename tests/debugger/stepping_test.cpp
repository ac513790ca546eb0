#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "debug_client.h"
#include "programs.h"

namespace isocnc::debugger {
namespace {

using testing::HasSubstr;

TEST(Stepping, StandsBeforeTheFirstBlock) {
  DebugClient client;
  client.launch(kPart, {{"stopOnEntry", true}});
  EXPECT_EQ(client.run("configurationDone").at("reason"), "entry");
  EXPECT_EQ(client.line(), 2);
  EXPECT_EQ(client.end(), 0);
}

TEST(Stepping, GoesABlockOnAndBack) {
  DebugClient client;
  client.stop_at_start(kPart);
  std::vector<std::string> states;
  std::vector<int> lines;
  for (int i = 0; i < 12; ++i) {
    states.push_back(client.state());
    lines.push_back(client.line());
    EXPECT_EQ(client.run("next").at("reason"), "step");
  }
  EXPECT_EQ(lines, (std::vector<int>{2, 3, 4, 5, 7, 8, 9, 10, 11, 12, 14, 15}));
  for (std::size_t i = states.size(); i-- > 0;) {
    EXPECT_EQ(client.run("stepBack").at("reason"), "step");
    EXPECT_EQ(client.state(), states[i]) << i;
  }
}

TEST(Stepping, RunsToTheEnd) {
  DebugClient client;
  client.launch(kPart);
  client.request("configurationDone");
  EXPECT_EQ(client.event("exited").at("exitCode"), 0);
  client.event("terminated");
  EXPECT_THAT(client.refusal("next"), HasSubstr("launched"));
}

TEST(Stepping, ReportsWhatTheOperatorWouldSee) {
  DebugClient client;
  client.launch(kPart);
  client.request("configurationDone");
  for (const char* const text :
       {"tool change: T101001", "spindle speed: S18000", "M03", "T101002", "M100 P1=2.5 P2=8"}) {
    const Json output = client.event("output");
    EXPECT_THAT(output.at("output").get<std::string>(), HasSubstr(text));
    EXPECT_EQ(output.at("source").at("path"), client.program().string());
  }
}

TEST(Stepping, ReportsASignalByTheTextInItsRow) {
  DebugClient client;
  client.launch("G990\nM02\n");
  client.request("configurationDone");
  EXPECT_EQ(client.event("output").at("output"), "G990: technological parameters are read anew\n");
}

TEST(Stepping, AnErrorStopsTheRunAndCanBeSteppedBackFrom) {
  DebugClient client;
  client.launch(kWrong);
  const Json stopped = client.run("configurationDone");
  EXPECT_EQ(stopped.at("reason"), "exception");
  EXPECT_EQ(stopped.at("text"), "ISO028");
  EXPECT_EQ(client.line(), 4);
  const Json info = client.request("exceptionInfo", {{"threadId", 1}});
  EXPECT_EQ(info.at("exceptionId"), "ISO028");
  EXPECT_FALSE(info.at("details").at("stackTrace").get<std::string>().empty());
  EXPECT_EQ(client.evaluate("Z"), "-1");
  client.run("stepBack");
  EXPECT_EQ(client.line(), 4);
  client.run("stepBack");
  EXPECT_EQ(client.line(), 3);
  EXPECT_EQ(client.evaluate("Z"), "5");
  client.request("continue");
  EXPECT_EQ(client.event("stopped").at("reason"), "exception");
  client.request("continue");
  EXPECT_EQ(client.event("exited").at("exitCode"), 1);
}

TEST(Stepping, WithoutTheFilterAnErrorEndsTheRun) {
  DebugClient client;
  client.launch(kWrong);
  client.request("setExceptionBreakpoints", {{"filters", Json::array()}});
  client.request("configurationDone");
  EXPECT_EQ(client.event("exited").at("exitCode"), 1);
}

TEST(Stepping, WhatEndsTheRunIsReportedAfterAnyAmountOfOutput) {
  std::string many = "M06 T101001\n";
  for (int i = 0; i < 1000; ++i) many += "M100\n";
  DebugClient client;
  client.launch(many + "G02\nM02\n", {{"noDebug", true}});
  client.request("configurationDone");
  EXPECT_EQ(client.event("exited").at("exitCode"), 1);
  std::string output;
  while (client.has_event("output")) output += client.event("output").at("output");
  EXPECT_THAT(output, HasSubstr("ISO026: "));
  EXPECT_THAT(output, HasSubstr("801 more messages are left out"));
}

TEST(Stepping, StepsInByInstructions) {
  DebugClient client;
  client.stop_at_start("M06 T101001\nG01 X10 F600 M03\nM02\n");
  client.run("next");
  client.run("stepIn");
  EXPECT_EQ(client.line(), 2);
  EXPECT_EQ(client.evaluate("X"), "0");
  client.run("stepIn");
  EXPECT_EQ(client.line(), 2);
  EXPECT_EQ(client.evaluate("X"), "10");
  client.run("stepBack", {{"granularity", "instruction"}});
  EXPECT_EQ(client.evaluate("X"), "0");
  client.run("stepIn");
  client.run("stepIn");
  EXPECT_EQ(client.line(), 3);
}

TEST(Stepping, StepsInByTheSegmentsOfAFiveAxisArc) {
  DebugClient client;
  client.stop_at_start(kFiveAxisArc);
  for (int i = 0; i < 3; ++i) client.run("next");
  client.run("stepIn");
  for (int number = 1; number <= 3; ++number) {
    const Json frames = client.request("stackTrace", {{"threadId", 1}}).at("stackFrames");
    ASSERT_EQ(frames.size(), 2u);
    EXPECT_THAT(frames.at(0).at("name").get<std::string>(), HasSubstr("segment " + std::to_string(number) + " of "));
    EXPECT_EQ(frames.at(1).at("name"), "G03 X20 Y0 I10 J0 F1000");
    client.run("stepIn");
  }
  client.run("next");
  EXPECT_EQ(client.line(), 5);
  EXPECT_EQ(client.evaluate("X"), "20");
}

TEST(Stepping, StepsOutToTheEndOfTheToolsSection) {
  DebugClient client;
  client.stop_at_start(kPart);
  for (int i = 0; i < 4; ++i) client.run("next");
  EXPECT_EQ(client.line(), 7);
  EXPECT_EQ(client.run("stepOut").at("reason"), "step");
  EXPECT_EQ(client.line(), 15);
}

TEST(Stepping, GoesToALineWithTheStateOfARunToIt) {
  DebugClient client;
  client.stop_at_start(kPart);
  for (int i = 0; i < 7; ++i) client.run("next");
  const int line = client.line();
  const std::string state = client.state();
  const auto go_to = [&](int target) {
    const Json targets = client.request("gotoTargets", {{"source", {}}, {"line", target}}).at("targets");
    return client.run("goto", {{"threadId", 1}, {"targetId", targets.at(0).at("id")}});
  };
  EXPECT_EQ(go_to(18).at("reason"), "goto");
  EXPECT_EQ(client.line(), 18);
  go_to(3);
  EXPECT_EQ(client.line(), 3);
  go_to(line);
  EXPECT_EQ(client.state(), state);
  go_to(13);  // The run jumps over it.
  EXPECT_EQ(client.state(), state);
}

TEST(Stepping, TheStackShowsTheJumpsThatHaveLedThere) {
  DebugClient client;
  client.launch(kPart);
  client.set_lines({14});
  client.run("configurationDone");
  const Json frames = client.request("stackTrace", {{"threadId", 1}}).at("stackFrames");
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames.at(0).at("name"), "N100 G00 Z50");
  EXPECT_EQ(frames.at(1).at("line"), 12);
  client.run("stepBack");
  EXPECT_EQ(client.request("stackTrace", {{"threadId", 1}}).at("totalFrames"), 1);
}

TEST(Stepping, TheStackShortensLongLinesBetweenCharacters) {
  DebugClient client;
  std::string line = "G00 X1 ;";
  line += std::string(79 - line.size(), 'x') + "àà";  // The first one lies across the end.
  client.stop_at_start("M06 T101001\n" + line + "\nM02\n");
  client.run("next");
  EXPECT_EQ(client.request("stackTrace", {{"threadId", 1}}).at("stackFrames").at(0).at("name"),
            line.substr(0, 79) + "…");
}

/// After an error nothing can be executed: a step lets the run end.
TEST(Stepping, AnyStepFromAnErrorEndsTheRun) {
  for (const char* const step : {"next", "stepIn", "stepOut", "continue"}) {
    DebugClient client;
    client.launch(kWrong);
    client.run("configurationDone");
    client.request(step);
    EXPECT_EQ(client.event("exited").at("exitCode"), 1) << step;
  }
}

/// A line that the run has not come through is not led to, neither ahead nor back.
TEST(Stepping, DoesNotGoBackToALineThatWasJumpedOver) {
  DebugClient client;
  client.launch(kPart);
  client.set_lines({16});
  client.run("configurationDone");
  const Json targets = client.request("gotoTargets", {{"source", {}}, {"line", 13}}).at("targets");
  EXPECT_EQ(client.run("goto", {{"threadId", 1}, {"targetId", targets.at(0).at("id")}}).at("reason"), "goto");
  EXPECT_EQ(client.line(), 16);
  std::string output;
  while (client.has_event("output")) output += client.event("output").at("output");
  EXPECT_THAT(output, HasSubstr("13"));
}

TEST(Stepping, ReportsTheNamesOfTheMachineFile) {
  DebugClient client;
  client.write("isocnc.json", R"({"machine": {"tools": [{"head": 1, "holder": 1, "tool": 1, "name": "ball nose"}],
                                               "functions": {"M100": {"name": "vacuum"}}}})");
  client.launch("M06 T101001\nM100 P1=2\nM02\n");
  client.request("configurationDone");
  client.event("terminated");
  std::string output;
  while (client.has_event("output")) output += client.event("output").at("output");
  EXPECT_THAT(output, HasSubstr("(ball nose)"));
  EXPECT_THAT(output, HasSubstr("M100 P1=2 (vacuum)"));
}

TEST(Stepping, PausesWithinAMoveAtTheVeryPlace) {
  DebugClient client;
  client.launch("M06 T101001\nG00 X0 Y0 Z0\nG01 X3000 F60\nM02\n", {{"speed", 10}});
  client.set_lines({3});
  client.run("configurationDone");
  client.request("continue");
  while (client.event("isocnc/position").at("programmed").at("x") <= 0) continue;
  EXPECT_EQ(client.run("pause").at("reason"), "pause");
  EXPECT_EQ(client.line(), 3);
  const double x = std::stod(client.evaluate("X,9"));
  EXPECT_GT(x, 0);
  EXPECT_LT(x, 3000);
  EXPECT_NEAR(std::stod(client.variable("Position", "Distance to go")), 3000 - x, 1e-3);
  client.run("stepBack");
  EXPECT_EQ(client.evaluate("X"), "0");
}

TEST(Stepping, RestartsWithWhatTheFileSaysNow) {
  DebugClient client;
  client.launch("M06 T101001\nG00 X1\nM02\n");
  client.set_lines({2});
  client.run("configurationDone");
  client.write("program.iso", "M06 T101001\n\nG00 X2\nM02\n");
  client.request("restart");
  EXPECT_EQ(client.event("breakpoint").at("breakpoint").at("line"), 3);
  client.event("stopped");
  EXPECT_EQ(client.line(), 3);
}

TEST(Stepping, StartsAtALine) {
  DebugClient client;
  client.launch(kPart, {{"startAtLine", 16}});
  EXPECT_EQ(client.run("configurationDone").at("reason"), "entry");
  EXPECT_EQ(client.line(), 16);
  EXPECT_EQ(client.evaluate("T"), "101002");
}

TEST(Stepping, RunsWithoutDebugging) {
  DebugClient client;
  client.launch(kPart, {{"noDebug", true}, {"stopOnEntry", true}});
  client.set_lines({7});
  client.request("configurationDone");
  client.event("terminated");
  EXPECT_FALSE(client.has_event("stopped"));
}

}  // namespace
}  // namespace isocnc::debugger
