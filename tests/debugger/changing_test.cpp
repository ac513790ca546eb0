#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "debug_client.h"
#include "debugger/debuggee/debuggee.h"
#include "programs.h"

namespace isocnc::debugger {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

Json reference_of(DebugClient& client, const std::string& scope) {
  for (const Json& each : Json(client.request("scopes", {{"frameId", 1}}).at("scopes")))
    if (each.at("name") == scope) return each.at("variablesReference");
  return nullptr;
}

TEST(Changing, ARegisterDecidesTheJumpsThatFollow) {
  DebugClient client;
  client.launch(kPart);
  client.set_lines({12, 13, 14});
  client.run("configurationDone");
  const Json arguments = {
      {"variablesReference", reference_of(client, "Registers")}, {"name", "V3"}, {"value", "2 * 3"}};
  EXPECT_EQ(client.request("setVariable", arguments).at("value"), "6");
  EXPECT_EQ(client.event("invalidated").at("areas"), Json({"all"}));
  client.run("continue");
  EXPECT_EQ(client.line(), 13);
}

TEST(Changing, ExpressionsThatNameSomethingCanBeSet) {
  DebugClient client;
  client.stop_at_start(kPart);
  for (const char* const name : {"V30", "VGPL", "S", "F", "OVERRIDE", "PLAYBACK"}) {
    EXPECT_EQ(client.request("setExpression", {{"expression", name}, {"value", "12.5"}}).at("value"), "12.5") << name;
    EXPECT_EQ(client.evaluate(name), "12.5") << name;
  }
}

TEST(Changing, VariablesThatAreShownCanBeSetWhereTheyMayBe) {
  DebugClient client;
  client.stop_at_start(kPart);
  const Json in_registers = {
      {"variablesReference", reference_of(client, "Registers")}, {"name", "V3"}, {"value", "2 * 4"}};
  EXPECT_EQ(client.request("setVariable", in_registers).at("value"), "8");
  EXPECT_EQ(client.evaluate("V3"), "8");
  for (const char* const name : {"X", "Machine", "oops"})
    EXPECT_EQ(
        client.refusal("setVariable",
                       {{"variablesReference", reference_of(client, "Position")}, {"name", name}, {"value", "1"}}),
        std::string(name) + " cannot be set");
}

/// The state after an S or an F that is set is the state after a block with it.
TEST(Changing, SpeedsThatAreSetDoAllThatTheProgramsDo) {
  const running::RunOptions options;
  const timing::TimedMachine machine;
  for (const std::string_view mode : {"G94", "G93", "G70"}) {
    const std::string text = "M06 T101001\n" + std::string(mode) + "\nG01 X1 F2\nX2 F3\nX3 F3\nM05\nM02\n";
    for (const char letter : {'S', 'F'}) {
      if (mode == "G93" && letter == 'F') continue;  // It cannot be set.
      debuggee::Debuggee by_hand(debuggee::ProgramText(text), options, machine);
      debuggee::Debuggee set(debuggee::ProgramText(text), options, machine);
      for (debuggee::Debuggee* const each : {&by_hand, &set})
        while (each->present().line() < 3) each->step_block();
      by_hand.run_by_hand(std::string(1, letter) + "7");
      if (letter == 'S') {
        set.set_spindle_speed(7);
      } else {
        set.set_feed(7);
      }
      EXPECT_EQ(set.present().run().state, by_hand.present().run().state) << mode << " " << letter;
    }
  }
}

/// All that is shown at once and at the end of the program, where the run comes to.
std::vector<std::string> states_after(const std::string& program, const std::function<void(DebugClient&)>& change) {
  DebugClient client;
  client.write("isocnc.json", R"({"machine": {"times": {"spindle": 3}}})");
  client.launch(program);
  client.set_lines({5, 12});
  client.run("configurationDone");
  change(client);
  std::vector<std::string> states{client.state()};
  client.run("continue");
  states.push_back(client.state());
  return states;
}

/// Whatever follows, a value that is set is one that a block typed into the console gives.
TEST(Changing, ASpeedThatIsSetLeadsToWhatABlockLeadsTo) {
  for (const char* const mode : {"G94", "G70", "G94 F700"}) {
    const std::string program = std::string("M06 T101001\nS5000 M03\n") + mode +
                                "\nG01 X1 F600\n"
                                "M03\n"  // 5: an S takes effect here.
                                "G01 X2\nX3\nG93\nX4 F2\nG94\nX9\nM02\n";
    for (const char* const name : {"F", "S"}) {
      const auto by_block =
          states_after(program, [&](DebugClient& client) { client.evaluate(std::string(name) + "300 G909", "repl"); });
      const auto by_value = states_after(program, [&](DebugClient& client) {
        client.request(
            "setVariable",
            {{"variablesReference", reference_of(client, "Feed and spindle")}, {"name", name}, {"value", "300"}});
      });
      const auto unchanged = states_after(program, [](DebugClient&) {});
      EXPECT_EQ(by_value, by_block) << mode << " " << name;
      EXPECT_NE(by_value.front(), unchanged.front()) << mode << " " << name;
      EXPECT_NE(by_value.back(), unchanged.back()) << mode << " " << name;
    }
  }
}

/// An S waits for the next M03, which takes as long as with an S of the program.
TEST(Changing, ASpindleSpeedThatIsSetWaitsForTheNextM03) {
  const auto time_at_end = [](const std::string& speed, const std::string& value) {
    DebugClient client;
    client.write("isocnc.json", R"({"machine": {"times": {"spindle": 3}}})");
    client.launch("M06 T101001\nS5000 M03\n" + speed + "\nM03\nM02\n");
    client.set_lines({4, 5});
    client.run("configurationDone");
    if (!value.empty()) client.request("setExpression", {{"expression", "S"}, {"value", value}});
    client.run("continue");
    return client.evaluate("TIME");
  };
  EXPECT_EQ(time_at_end("G90", "300"), time_at_end("S300", ""));
  EXPECT_NE(time_at_end("G90", "300"), time_at_end("G90", ""));
}

/// Under G93 a block with an F alone sets nothing (D43), and neither does the debugger.
TEST(Changing, AFeedIsNotSetUnderG93) {
  DebugClient client;
  client.launch("M06 T101001\nG01 X1 F600\nG93\nX2 F3\nG94\nX3\nM02\n");
  client.set_lines({4});
  client.run("configurationDone");
  const std::string state = client.state();
  EXPECT_THAT(client.refusal("setExpression", {{"expression", "F"}, {"value", "300"}}), HasSubstr("G93"));
  EXPECT_EQ(client.state(), state);
  client.evaluate("F300 G909", "repl");
  EXPECT_EQ(client.evaluate("F"), "600");
}

/// Blocks run by hand stand between no two lines of the program: a G09 after a feed move stays one (D23).
TEST(Changing, LeavesAG09AfterAFeedMoveValid) {
  for (const bool is_block : {false, true}) {
    DebugClient client;
    client.launch("M06 T101001\nG01 X1 F600\nG09\nM02\n");
    client.set_lines({3, 4});
    client.run("configurationDone");
    if (is_block) {
      client.evaluate("F300 G909", "repl");
    } else {
      client.request("setExpression", {{"expression", "F"}, {"value", "300"}});
    }
    EXPECT_EQ(client.run("continue").at("reason"), "breakpoint") << is_block;
  }
}

/// The machine cannot be changed within a block, nor after the end.
TEST(Changing, WaitsForAMachineThatStandsBetweenTwoBlocks) {
  DebugClient client;
  client.stop_at_start("M06 T101001\nG01 X10 F600 M03\nM02\n");
  client.run("next");
  client.run("stepIn");
  client.run("stepIn");
  EXPECT_THAT(client.refusal("setExpression", {{"expression", "OVERRIDE"}, {"value", "50"}}), HasSubstr("block"));
}

struct Refused {
  std::string expression;
  std::string value;
  std::string message;
};

class Refusals : public testing::TestWithParam<Refused> {};

TEST_P(Refusals, SayWhy) {
  DebugClient client;
  client.stop_at_start(kPart);
  EXPECT_THAT(client.refusal("setExpression", {{"expression", GetParam().expression}, {"value", GetParam().value}}),
              HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(All, Refusals,
                         testing::Values(Refused{"X", "1", "X cannot be set"}, Refused{"V3 + 1", "1", "cannot be set"},
                                         Refused{"V3", "oops", "nothing called oops"},
                                         Refused{"V3", "1/0", "V3 cannot be"}, Refused{"F", "0", "F cannot be 0"},
                                         Refused{"S", "-1", "S cannot be -1"},
                                         Refused{"OVERRIDE", "2000", "OVERRIDE cannot be"}));

TEST(Changing, AFeedOverrideMakesTheRestTakeLonger) {
  const std::string program = "M06 T101001\nG00 X0\nG01 X1000 F600\nM02\n";
  double times[2];
  for (const bool is_halved : {false, true}) {
    DebugClient client;
    client.launch(program);
    client.set_lines({3});
    client.run("configurationDone");
    const double begin = std::stod(client.evaluate("TIME,6"));
    if (is_halved) client.request("setExpression", {{"expression", "OVERRIDE"}, {"value", "50"}});
    client.run("next");
    times[is_halved ? 1 : 0] = std::stod(client.evaluate("TIME,6")) - begin;
    EXPECT_EQ(client.evaluate("XM"), "1000");
  }
  EXPECT_NEAR(times[0], 100, 1);
  EXPECT_NEAR(times[1], 200, 1);
}

TEST(Console, RunsBlocksOnTheMachineAndStepsBackOverThem) {
  DebugClient client;
  client.launch(kPart);
  client.set_lines({9});
  client.run("configurationDone");
  const std::string state = client.state();
  EXPECT_THAT(client.evaluate("G00 Z30", "repl"), HasSubstr("ZM 30"));
  EXPECT_EQ(client.evaluate("Z"), "30");
  EXPECT_EQ(client.evaluate("MOTION"), "0");
  EXPECT_EQ(client.line(), 9);
  client.run("stepBack");
  EXPECT_EQ(client.state(), state);
}

TEST(Console, WhatIsUndoneIsNotRemembered) {
  DebugClient client;
  client.launch(kPart);
  client.set_lines({12, 14});
  client.run("configurationDone");
  client.evaluate("V3=1 G909", "repl");
  client.run("continue");
  EXPECT_EQ(client.request("stackTrace", {{"threadId", 1}}).at("totalFrames"), 1);  // It has not jumped.
  for (int i = 0; i < 3; ++i) client.run("stepBack");
  client.run("continue");
  EXPECT_EQ(client.line(), 14);
  EXPECT_EQ(client.request("stackTrace", {{"threadId", 1}}).at("totalFrames"), 2);
}

TEST(Console, GoesOnFromWhereItsBlocksHaveLed) {
  DebugClient client;
  client.launch(kPart);
  client.set_lines({9});
  client.run("configurationDone");
  client.evaluate("G00 Z30", "repl");
  client.evaluate("G01 F500 X12", "repl");
  client.run("next");
  EXPECT_EQ(client.line(), 10);
  EXPECT_EQ(client.evaluate("X"), "40");
  EXPECT_EQ(client.evaluate("Z"), "30");
  client.set_lines({});
  client.request("continue");
  client.event("terminated");
}

TEST(Console, KeepsBlocksForAG909) {
  DebugClient client;
  client.launch(kPart);
  client.set_lines({9});
  client.run("configurationDone");
  EXPECT_EQ(client.evaluate("G91", "repl"), "waits for G909");
  EXPECT_EQ(client.evaluate("V5=3", "repl"), "waits for G909");
  EXPECT_EQ(client.evaluate("DISTANCE"), "90");
  EXPECT_EQ(client.evaluate("X", "repl"), "10");
  client.evaluate("G00 X1 G909", "repl");
  EXPECT_EQ(client.evaluate("DISTANCE"), "91");
  EXPECT_EQ(client.evaluate("V5"), "3");
  EXPECT_EQ(client.evaluate("X"), "11");
}

TEST(Console, AWrongBlockDoesNothing) {
  DebugClient client;
  client.launch(kPart);
  client.set_lines({9});
  client.run("configurationDone");
  const std::string state = client.state();
  EXPECT_THAT(client.refusal("evaluate", {{"expression", "G00 Z30\nG02 X5"}, {"context", "repl"}}),
              HasSubstr("ISO028"));
  EXPECT_EQ(client.state(), state);
}

TEST(Console, AnswersExpressions) {
  DebugClient client;
  client.stop_at_start(kPart, {{"registers", {{"V2", 255}}}, {"vgpl", 4}, {"decimals", 2}});
  EXPECT_EQ(client.evaluate("V2 / 3", "repl"), "85");
  EXPECT_EQ(client.evaluate("V2,x", "repl"), "0xFF");
  EXPECT_EQ(client.evaluate("=1-3", "repl"), "-2");
  EXPECT_EQ(client.evaluate("VGPL / 3", "repl"), "1.33");
  EXPECT_EQ(client.evaluate("X10.5", "hover"), "0");
  EXPECT_EQ(client.request("evaluate", {{"expression", "V2"}, {"format", {{"hex", true}}}}).at("result"), "0xFF");
}

TEST(Console, CompletesNamesAndCodes) {
  DebugClient client;
  client.stop_at_start(kPart);
  std::vector<std::string> labels;
  for (const Json& each : Json(client.request("completions", {{"text", "Z + v1"}, {"column", 7}}).at("targets"))) {
    labels.push_back(each.at("label"));
    EXPECT_EQ(each.at("start"), 5);
  }
  EXPECT_EQ(labels.size(), 11u);
  EXPECT_THAT(labels, Contains("V17"));
}

TEST(Reading, ModesShowWhatHasSetThem) {
  DebugClient client;
  client.launch("M06 T101001\nG92 X1\nG00 X0\nG92 X2\nG91 X1\nX1\nM02\n");
  client.set_lines({4, 6});
  client.run("configurationDone");
  EXPECT_THAT(client.variable("Modal groups", "workpiece frame"), HasSubstr("(line 2)"));
  EXPECT_THAT(client.variable("Modal groups", "absolute or incremental"), HasSubstr("(default)"));
  client.run("continue");
  EXPECT_THAT(client.variable("Modal groups", "workpiece frame"), HasSubstr("(line 4)"));
  EXPECT_THAT(client.variable("Modal groups", "absolute or incremental"), HasSubstr("(line 5)"));
  client.evaluate("G90 G909", "repl");
  EXPECT_THAT(client.variable("Modal groups", "absolute or incremental"), HasSubstr("(by hand)"));
  client.run("stepBack");
  EXPECT_THAT(client.variable("Modal groups", "absolute or incremental"), HasSubstr("(line 5)"));
}

/// The journal keeps the latest settings alone; the others are found again.
TEST(Reading, ModesShowWhatHasSetThemInLongProgramsToo) {
  std::string program = "M06 T101001\nG01 X0 F6000\n";
  for (int i = 0; i < 20'000; ++i) program += "G00 X0\nX0\nG01 X0\n";
  DebugClient client;
  client.launch(program + "M02\n", {{"stopOnEntry", true}});
  client.run("configurationDone");
  const auto motion_at = [&](int line) {
    const Json targets = client.request("gotoTargets", {{"source", {}}, {"line", line}}).at("targets");
    client.run("goto", {{"threadId", 1}, {"targetId", targets.at(0).at("id")}});
    return client.variable("Modal groups", "motion");
  };
  EXPECT_THAT(motion_at(60'003), HasSubstr("G01 linear interpolation (line 60002)"));
  EXPECT_THAT(motion_at(33), HasSubstr("G01 linear interpolation (line 32)"));
  EXPECT_THAT(motion_at(32), HasSubstr("G00 rapid positioning (line 30)"));
  EXPECT_THAT(motion_at(4), HasSubstr("G00 rapid positioning (line 3)"));
}

TEST(Reading, ScopesShowTheMachine) {
  DebugClient client;
  client.launch(kPart);
  client.set_lines({18});
  client.run("configurationDone");
  EXPECT_EQ(client.variable("Position", "Machine"), "X 100 Y 50 Z 50 B 0 C 0");
  EXPECT_EQ(client.variable("Position", "Workpiece"), "X 0 Y 0 Z 50 B 0 C 0");
  EXPECT_EQ(client.variable("Modal groups", "motion"), "G01 linear interpolation (line 16)");
  EXPECT_EQ(client.variable("Modal groups", "arc plane"), "G17 arc plane XY (line 2)");
  EXPECT_EQ(client.variable("Modal groups", "interpolation"), "G48 three-axis interpolation (default)");
  EXPECT_EQ(client.variable("Feed and spindle", "Spindle"), "M03, clockwise");
  EXPECT_EQ(client.variable("Tool", "T"), "101002");
  EXPECT_EQ(client.variable("Registers", "V3"), "7");
  EXPECT_EQ(client.variable("GPL variables", "TValues"), "1, 1, 2");
  EXPECT_EQ(client.variable("GPL variables", "SValue"), "18000");
  EXPECT_THAT(client.below("GPL variables", "MxMFunParams"), ElementsAre("[100]=P1=2.5 P2=8"));
}

/// Whatever is shown as a sum opens into what it is made of.
TEST(Reading, GroupsOpen) {
  DebugClient client;
  client.write("isocnc.json", R"({"machine": {"tools": [{"head": 1, "holder": 1, "tool": 1, "name": "\u00d8 8"}]}})");
  client.launch(
      "M06 T101001\n"
      "M100 P1=2 P3=4\n"
      "M100 P1=2.5\n"
      "G92 X100 Y50 Z10\n"
      "G29 X10 Y20 Z30 C90\n"
      "G00 X1 Y2 Z3 B0 C90\n"
      "M05\n"
      "M02\n");
  client.set_lines({7});
  client.run("configurationDone");
  EXPECT_THAT(client.below("Position", "Machine"), ElementsAre("XM=108", "YM=71", "ZM=43", "BM=0", "CM=90"));
  EXPECT_THAT(client.below("Position", "Workpiece"), ElementsAre("XW=8", "YW=21", "ZW=33"));
  EXPECT_THAT(client.below("Position", "Face"), ElementsAre("X=1", "Y=2", "Z=3"));
  EXPECT_THAT(client.below("Position", "Joints"), ElementsAre("XJ=108", "YJ=71", "ZJ=43", "BJ=0", "CJ=90"));
  EXPECT_THAT(client.below("Position", "Distance to go"), ElementsAre("X=0", "Y=0", "Z=0", "B=0", "C=0", "Path=0"));
  EXPECT_THAT(client.below("Frames", "Workpiece (machine frame)"), ElementsAre("X=100", "Y=50", "Z=10"));
  EXPECT_THAT(client.below("Frames", "Face (workpiece frame)"),
              ElementsAre("Origin=X 10 Y 20 Z 30", "i=X 0 Y 1 Z 0", "j=X -1 Y 0 Z 0", "k=X 0 Y 0 Z 1"));
  EXPECT_THAT(client.below("GPL variables", "TValues"), ElementsAre("[1]=1", "[2]=1", "[3]=1"));
  EXPECT_THAT(client.below("GPL variables", "MxMFunParams"), ElementsAre("[100]=P1=2.5"));
  EXPECT_EQ(client.variable("Tool", "Name"), "Ø 8");
  EXPECT_EQ(client.evaluate("SPINDLE"), "5");
  const Json parameters = client.request("variables", {{"variablesReference", 1100}}).at("variables");
  ASSERT_EQ(parameters.size(), 1u);
  EXPECT_EQ(parameters.at(0).at("name"), "P1");
  EXPECT_EQ(parameters.at(0).at("value"), "2.5");
}

}  // namespace
}  // namespace isocnc::debugger
