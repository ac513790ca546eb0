#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "debug_client.h"
#include "programs.h"

namespace isocnc::debugger {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(Breakpoints, MoveToTheNextBlock) {
  DebugClient client;
  client.launch(kPart);
  const Json breakpoints = client.set_lines({1, 6, 8, 500});
  EXPECT_EQ(breakpoints.at(0).at("line"), 2);
  EXPECT_EQ(breakpoints.at(1).at("line"), 7);
  EXPECT_EQ(breakpoints.at(2).at("line"), 8);
  EXPECT_FALSE(breakpoints.at(3).at("verified"));
  EXPECT_EQ(client.run("configurationDone").at("hitBreakpointIds"), Json::array({breakpoints.at(0).at("id")}));
  EXPECT_EQ(client.line(), 2);
  EXPECT_EQ(client.run("continue").at("reason"), "breakpoint");
  EXPECT_EQ(client.line(), 7);
  client.run("continue");
  EXPECT_EQ(client.line(), 8);
  client.run("reverseContinue");
  EXPECT_EQ(client.line(), 7);
  client.run("reverseContinue");
  EXPECT_EQ(client.line(), 2);
}

TEST(Breakpoints, GoBackToTheStartWhereNothingStops) {
  DebugClient client;
  client.launch(kPart);
  client.set_lines({16});
  client.run("configurationDone");
  client.set_lines({});
  EXPECT_EQ(client.run("reverseContinue").at("reason"), "entry");
  EXPECT_EQ(client.line(), 2);
  EXPECT_EQ(client.evaluate("TIME"), "0");
}

struct ConditionCase {
  Json breakpoint;
  int line;  ///< That the run stops at; 0: it does not.
};

class Conditions : public testing::TestWithParam<ConditionCase> {};

TEST_P(Conditions, DecideWhetherTheRunStops) {
  DebugClient client;
  client.launch(kPart);
  client.set_breakpoints({GetParam().breakpoint});
  client.request("configurationDone");
  if (GetParam().line == 0) {
    client.event("terminated");
    EXPECT_FALSE(client.has_event("stopped"));
    return;
  }
  client.event("stopped");
  EXPECT_EQ(client.line(), GetParam().line);
}

INSTANTIATE_TEST_SUITE_P(
    All, Conditions,
    testing::Values(ConditionCase{{{"line", 9}, {"condition", "Z < 0 && S > 0"}}, 9},
                    ConditionCase{{{"line", 9}, {"condition", "Z >= 0 || S == 0"}}, 0},
                    ConditionCase{{{"line", 11}, {"condition", "V3 = 7"}}, 11},
                    ConditionCase{{{"line", 9}, {"condition", "XM > 109.9 && XW < 10.1"}}, 9},
                    ConditionCase{{{"line", 9}, {"condition", "MOTION == 1 && !(FEEDMODE == 93)"}}, 9},
                    ConditionCase{{{"line", 16}, {"condition", "T == 101002"}}, 16},
                    ConditionCase{{{"line", 9}, {"hitCondition", "1"}}, 9},
                    ConditionCase{{{"line", 9}, {"hitCondition", ">1"}}, 0}, ConditionCase{{{"line", 13}}, 0},
                    ConditionCase{{{"line", 9}, {"condition", "Z <= -2 && XJ <= 110.5"}}, 9},
                    ConditionCase{{{"line", 9}, {"condition", "Z <= -2.001"}}, 0}));

struct HitCase {
  std::string condition;
  std::vector<int> hits;  ///< Of M06 in lines 1, 2, 3 and 4, which the run stops at.
};

class HitConditions : public testing::TestWithParam<HitCase> {};

TEST_P(HitConditions, CountFromTheFirst) {
  DebugClient client;
  client.launch("M06 T101001\nM06 T101002\nM06 T101003\nM06 T101004\nM02\n");
  client.request("setFunctionBreakpoints",
                 {{"breakpoints", {{{"name", "M6"}, {"hitCondition", GetParam().condition}}}}});
  client.set_lines({5});
  std::vector<int> hits;
  client.run("configurationDone");
  for (; client.line() != 5; client.run("continue")) hits.push_back(client.line());
  EXPECT_EQ(hits, GetParam().hits);
}

INSTANTIATE_TEST_SUITE_P(All, HitConditions,
                         testing::Values(HitCase{"2", {2}}, HitCase{"= 3", {3}}, HitCase{"== 3", {3}},
                                         HitCase{"< 3", {1, 2}}, HitCase{"<= 3", {1, 2, 3}}, HitCase{"> 3", {4}},
                                         HitCase{">= 3", {3, 4}}, HitCase{"% 2", {2, 4}}));

/// What older clients send.
TEST(Breakpoints, CanBeLinesAlone) {
  DebugClient client;
  client.launch(kPart);
  const Json breakpoints =
      client.request("setBreakpoints", {{"source", {{"path", client.program().string()}}}, {"lines", {6, 8}}})
          .at("breakpoints");
  ASSERT_EQ(breakpoints.size(), 2u);
  EXPECT_EQ(breakpoints.at(0).at("line"), 7);
  EXPECT_EQ(breakpoints.at(1).at("line"), 8);
  client.run("configurationDone");
  EXPECT_EQ(client.line(), 7);
}

TEST(Breakpoints, ReportTheColumnOfAConditionsMistake) {
  DebugClient client;
  client.launch(kPart);
  const Json breakpoints = client.set_breakpoints({{{"line", 9}, {"condition", "Z < 0 && W > 1"}},
                                                   {{"line", 9}, {"condition", "(Z"}},
                                                   {{"line", 9}, {"hitCondition", "often"}},
                                                   {{"line", 9}, {"logMessage", "Z is {Z"}}});
  EXPECT_EQ(breakpoints.at(0).at("message"), "column 10: there is nothing called W");
  EXPECT_EQ(breakpoints.at(1).at("message"), "column 1: this parenthesis is not closed");
  EXPECT_THAT(breakpoints.at(2).at("message").get<std::string>(), HasSubstr("often"));
  EXPECT_EQ(breakpoints.at(3).at("message"), "{ has no } after it");
  for (const Json& breakpoint : breakpoints) EXPECT_FALSE(breakpoint.at("verified"));
}

TEST(Breakpoints, LogPointsReportAndDoNotStop) {
  DebugClient client;
  client.launch("M06 T101001\nG00 X12.3456 Z5\nG01 Z-1 F100\nM02\n");
  client.set_breakpoints({{{"line", 3}, {"logMessage", "at {X,2} {{mm}}, T {T,x}"}}});
  client.request("configurationDone");
  client.event("output");  // The tool change.
  EXPECT_EQ(client.event("output").at("output"), "at 12.35 {mm}, T 0x18A89\n");
  client.event("terminated");
  EXPECT_FALSE(client.has_event("stopped"));
}

TEST(Breakpoints, NoMessageOfALogPointIsLeftOut) {
  std::string many = "M06 T101001\n";
  for (int i = 0; i < 500; ++i) many += "M100\n";
  DebugClient client;
  client.launch(many + "M02\n");
  std::vector<Json> breakpoints;
  for (int i = 0; i < 500; ++i) breakpoints.push_back({{"line", i + 2}, {"logMessage", "here {LINE}"}});
  client.set_breakpoints(breakpoints);
  client.request("configurationDone");
  client.event("terminated");
  int messages = 0;
  while (client.has_event("output"))
    messages += client.event("output").at("output").get<std::string>().starts_with("here ") ? 1 : 0;
  EXPECT_EQ(messages, 500);
}

/// Lines at which a run stops, on and then back.
struct Stops {
  std::vector<int> on;
  std::vector<int> back;
};

Stops stops_of(DebugClient& client) {
  Stops stops;
  client.request("configurationDone");
  for (;;) {
    Json stopped;
    while (!client.has_event("stopped") && !client.has_event("terminated")) std::this_thread::yield();
    if (!client.has_event("stopped")) return stops;
    client.event("stopped");
    stops.on.push_back(client.line());
    if (stops.on.back() >= 16) break;
    client.request("continue");
  }
  while (client.run("reverseContinue").at("reason") != "entry") stops.back.push_back(client.line());
  return stops;
}

/// Lines at which exceptions stop a run, forward and then backward from the line `end`.
Stops stops_before(DebugClient& client, int end) {
  client.set_lines({end});
  Stops stops;
  for (Json stopped = client.run("configurationDone"); stopped.at("reason") == "exception";
       stopped = client.run("continue"))
    stops.on.push_back(client.line());
  EXPECT_EQ(client.line(), end);
  client.set_lines({});
  while (client.run("reverseContinue").at("reason") != "entry") stops.back.push_back(client.line());
  return stops;
}

TEST(Breakpoints, FunctionBreakpointsWaitForCodes) {
  DebugClient client;
  client.launch(kPart);
  const Json breakpoints =
      client
          .request("setFunctionBreakpoints",
                   {{"breakpoints", {{{"name", "M06"}}, {{"name", "m100"}}, {{"name", "G29"}}, {{"name", "X10"}}}}})
          .at("breakpoints");
  EXPECT_TRUE(breakpoints.at(2).at("verified"));
  EXPECT_FALSE(breakpoints.at(3).at("verified"));
  const Stops stops = stops_of(client);
  EXPECT_THAT(stops.on, ElementsAre(4, 15, 17));
  EXPECT_THAT(stops.back, ElementsAre(15, 4));
}

/// As a client does it that sets all breakpoints of a file when one of them changes.
TEST(Breakpoints, ThatAreSetAnewAsTheyAreGoOnCounting) {
  DebugClient client;
  client.launch("M06 T101001\nG00 X1\nM100\nX2\nM100\nX3\nM100\nX4\nM100\nM02\n");
  const auto set_hits = [&](const char* hits, const char* data_hits) {
    client.request("setFunctionBreakpoints", {{"breakpoints", {{{"name", "M100"}, {"hitCondition", hits}}}}});
    client.request("setDataBreakpoints", {{"breakpoints", {{{"dataId", "X"}, {"hitCondition", data_hits}}}}});
  };
  set_hits("2", "3");
  client.run("configurationDone");
  EXPECT_EQ(client.line(), 5);
  set_hits("2", "3");
  client.run("continue");
  EXPECT_EQ(client.line(), 7) << "the third X";
  set_hits("=2", "99");
  client.run("continue");
  EXPECT_EQ(client.line(), 9) << "another condition counts from line 7";
}

TEST(Breakpoints, FunctionBreakpointsCountTheirHits) {
  DebugClient client;
  client.launch(kPart);
  client.request("setFunctionBreakpoints", {{"breakpoints", {{{"name", "M6"}, {"hitCondition", "2"}}}}});
  client.run("configurationDone");
  EXPECT_EQ(client.line(), 15);
}

TEST(Breakpoints, DataBreakpointsWatchValuesAndThresholds) {
  DebugClient client;
  client.launch(kPart);
  for (const char* const name : {"V3", "Z = 0", "T"})
    EXPECT_EQ(client.request("dataBreakpointInfo", {{"name", name}}).at("dataId"), name);
  EXPECT_TRUE(client.request("dataBreakpointInfo", {{"name", "W"}}).at("dataId").is_null());
  client.request("setDataBreakpoints", {{"breakpoints", {{{"dataId", "V3"}}, {{"dataId", "Z = 0"}}}}});
  const Stops stops = stops_of(client);
  EXPECT_THAT(stops.on, ElementsAre(9, 11, 15));
}

/// Arcs that come back to the height that they begin at: over it, less far over it, and under it.
TEST(Breakpoints, ThresholdsCountOnThePathAlongAnArc) {
  for (const char* const mode : {"G48", "G49"}) {
    DebugClient client;
    client.launch(std::string("M06 T101001\nG00 X0 Y0 Z5\n") + mode +
                  "\nG18\n"
                  "G03 X20 Z5 I10 K5 F2000\n"  // 5
                  "G01 Z4\n"                   // 6
                  "G02 X0 Z4 I10 K4\n"         // 7
                  "G02 X20 Z4 I10 K4\n"        // 8
                  "G01 Z5\n"                   // 9
                  "M02\n");
    client.request("setDataBreakpoints", {{"breakpoints", {{{"dataId", "Z = 0"}}, {{"dataId", "ZM = 14.5"}}}}});
    client.set_lines({10});
    std::vector<int> stops;
    Json stopped;
    for (stopped = client.run("configurationDone"); stopped.at("reason") != "breakpoint";
         stopped = client.run("continue"))
      stops.push_back(client.line());
    EXPECT_THAT(stops, ElementsAre(6, 9)) << mode;
    client.set_lines({});
    std::vector<int> back;
    while (client.run("reverseContinue").at("reason") != "entry") back.push_back(client.line());
    EXPECT_THAT(back, ElementsAre(9, 6)) << mode;
  }
}

TEST(Breakpoints, DataBreakpointsWatchWhatTheClientShows) {
  DebugClient client;
  client.stop_at_start(kPart);
  const auto id_of = [&](const char* scope, const char* name) {
    for (const Json& each : Json(client.request("scopes", {{"frameId", 1}}).at("scopes")))
      if (each.at("name") == scope)
        return client.request("dataBreakpointInfo",
                              {{"variablesReference", each.at("variablesReference")}, {"name", name}});
    return Json();
  };
  EXPECT_EQ(id_of("Modal groups", "motion").at("dataId"), "MOTION");
  EXPECT_EQ(id_of("Position", "Z").at("dataId"), "Z");
  EXPECT_EQ(id_of("GPL variables", "Var_IF[1]").at("dataId"), "VGPL");
  EXPECT_TRUE(id_of("Position", "Joints").at("dataId").is_null());
  client.request("setDataBreakpoints", {{"breakpoints", {{{"dataId", "MOTION"}}}}});
  std::vector<int> lines;
  for (int i = 0; i < 3; ++i) {
    client.run("continue");
    lines.push_back(client.line());
  }
  EXPECT_THAT(lines, ElementsAre(8, 9, 12));
}

TEST(Breakpoints, DataBreakpointsWorkBackwards) {
  DebugClient client;
  client.launch(kPart);
  client.set_lines({16});
  client.run("configurationDone");
  client.set_lines({});
  client.request("setDataBreakpoints", {{"breakpoints", {{{"dataId", "V3"}}, {{"dataId", "Z = 0"}}}}});
  std::vector<int> lines;
  while (client.run("reverseContinue").at("reason") != "entry") lines.push_back(client.line());
  EXPECT_THAT(lines, ElementsAre(15, 11, 9));
}

/// A search backward judges the block in error, too, which changes nothing.
TEST(Breakpoints, DataBreakpointsWorkBackwardsFromAnError) {
  DebugClient client;
  client.launch(kWrong);
  EXPECT_EQ(client.run("configurationDone").at("reason"), "exception");
  client.request("setDataBreakpoints", {{"breakpoints", {{{"dataId", "Z = 0"}}}}});
  EXPECT_EQ(client.run("reverseContinue").at("reason"), "data breakpoint");
  EXPECT_EQ(client.line(), 4);
  EXPECT_EQ(client.evaluate("Z"), "-1");
}

TEST(Breakpoints, ExceptionsAreWhatTheFiltersSay) {
  DebugClient client;
  client.launch(kPart);
  client.request("setExceptionBreakpoints", {{"filters", {"errors", "toolChange", "firstCut"}}});
  const Stops stops = stops_of(client);
  EXPECT_THAT(stops.on, ElementsAre(4, 8, 15, 16));
  EXPECT_THAT(stops.back, ElementsAre(15, 8, 4));
}

/// Blocks of the console count: they mount a tool, and they cut.
TEST(Breakpoints, TheFirstCutOfAToolMayBeMadeByHand) {
  DebugClient client;
  client.launch("M06 T101001\nG00 X1\nG01 X2 F100\nX3\nG00 X4\nG01 X5\nM02\n");
  client.request("setExceptionBreakpoints", {{"filters", {"firstCut"}}});
  client.set_lines({2, 5});
  client.run("configurationDone");
  EXPECT_EQ(client.line(), 2);
  client.evaluate("G01 X1.5 F100", "repl");
  EXPECT_EQ(client.run("continue").at("reason"), "breakpoint");
  EXPECT_EQ(client.line(), 5);
  client.evaluate("M06 T101002", "repl");
  client.evaluate("G01 Z0", "repl");
  client.evaluate("M06 T101003", "repl");
  client.set_lines({});
  EXPECT_EQ(client.run("continue").at("text"), "firstCut");
  EXPECT_EQ(client.line(), 6);
}

TEST(Breakpoints, WarningsStopTheRunWhereTheyAreAskedFor) {
  DebugClient client;
  client.launch("M06 T101001\nG00 X1\nG17\nG17\nM02\n", {{"breakOnWarnings", true}});
  const Json stopped = client.run("configurationDone");
  EXPECT_EQ(stopped.at("text"), "W001");
  EXPECT_EQ(client.line(), 4);
}

/// The rules of style that the shop has switched on are among the warnings, and what it has switched off is not: the
/// same order of style, comments and selection as in isolint.
TEST(Breakpoints, WarningsAreThoseThatIsolintShows) {
  const char* const program = "M06 T101001\nG00 X1 ;isolint: ignore W001\ng00 x2\nM02\n";
  DebugClient with_style;
  with_style.write("isocnc.json", R"({"lint": {"severity": {"W125": "warning", "W190": "off"}}})");
  with_style.launch(program, {{"breakOnWarnings", true}});
  EXPECT_EQ(with_style.run("configurationDone").at("text"), "W125");
  EXPECT_EQ(with_style.line(), 3);
  DebugClient with_w190;
  with_w190.write("isocnc.json", R"({"lint": {"severity": {"W190": "warning"}}})");
  with_w190.launch(program, {{"breakOnWarnings", true}});
  EXPECT_EQ(with_w190.run("configurationDone").at("text"), "W190");
  EXPECT_EQ(with_w190.line(), 2);
}

/// A warning that repeats stops the run once, at the first line that it reaches.
TEST(Breakpoints, WarningsThatRepeatStopTheRunOnce) {
  const char* const program = "M06 T101001\nG93\nIF VGPL = 1 GOTO N10\nF4\nF5\nN10 G00 X1\nF6\nF7\nM05\nM02\n";
  DebugClient client;
  client.launch(program, {{"breakOnWarnings", true}, {"vgpl", 1}});
  EXPECT_EQ(client.run("configurationDone").at("text"), "W003");
  EXPECT_EQ(client.line(), 7);
  EXPECT_THAT(client.request("exceptionInfo", {{"threadId", 1}}).at("description").get<std::string>(),
              HasSubstr("(and 3 more lines, to line 8)"));
  DebugClient straight;
  straight.launch("M06 T101001\nG93\nF4\nF5\nG00 X1\nF6\nM05\nG17\nG17\nM02\n", {{"breakOnWarnings", true}});
  EXPECT_EQ(straight.run("configurationDone").at("text"), "W003");
  EXPECT_EQ(straight.line(), 3);
  EXPECT_EQ(straight.run("continue").at("text"), "W001");
}

/// The filters that the client sets do not turn off what the launch asks for.
TEST(Breakpoints, WarningsStopTheRunBesideTheFiltersOfTheClient) {
  DebugClient client;
  client.launch("M06 T101001\nG00 X1\nG17\nG17\nM02\n", {{"breakOnWarnings", true}});
  client.request("setExceptionBreakpoints", {{"filters", {"errors"}}});
  EXPECT_EQ(client.run("configurationDone").at("text"), "W001");
}

TEST(Breakpoints, TravelStopsTheRunBeforeTheMoveThatExceedsIt) {
  DebugClient client;
  client.write("isocnc.json", R"({"machine": {"axes": {"X": {"min": -10, "max": 100}}}})");
  client.launch("M06 T101001\nG00 X100\nX100.5\nX20\nM02\n");
  client.request("setExceptionBreakpoints", {{"filters", {"limits"}}});
  EXPECT_EQ(client.run("configurationDone").at("reason"), "exception");
  EXPECT_EQ(client.line(), 3);
  EXPECT_THAT(client.request("exceptionInfo", {{"threadId", 1}}).at("description").get<std::string>(),
              HasSubstr("100.5"));
}

/// X leaves its travel twice, the second time on two lines, and the entry of the contour gouges.
constexpr const char* kLimitedMachine = R"({"machine": {
    "axes": {"X": {"min": -10, "max": 100}},
    "tools": [{"head": 1, "holder": 1, "tool": 1, "radius": 10, "length": 40}]}})";
constexpr const char* kOutsideProgram =
    "M06 T101001\n"
    "G00 X130 Y0 ; 2\n"
    "X30 Y20\n"
    "X40\n"
    "X131 ; 5\n"
    "Y30\n"
    "X30 Y20\n"
    "G41 G01 X0 Y0 F6000 ; 8\n"
    "Y45\n"
    "G40\n"
    "M02\n";

TEST(Breakpoints, FindingsOfTheMachineStopTheRunBeforeTheirBlocks) {
  DebugClient client;
  client.write("isocnc.json", kLimitedMachine);
  client.launch(kOutsideProgram);
  client.request("setExceptionBreakpoints", {{"filters", {"run"}}});
  const Stops stops = stops_before(client, 10);
  EXPECT_THAT(stops.on, ElementsAre(2, 5, 8));
  EXPECT_THAT(stops.back, ElementsAre(8, 5, 2));
}

TEST(Breakpoints, FindingsOfTheMachineAreThoseOfARun) {
  DebugClient client;
  client.write("isocnc.json", kLimitedMachine);
  client.launch(kOutsideProgram);
  client.request("setExceptionBreakpoints", {{"filters", {"run"}}});
  const Json stopped = client.run("configurationDone");
  EXPECT_EQ(stopped.at("reason"), "exception");
  EXPECT_EQ(stopped.at("text"), "E160");
  const Json info = client.request("exceptionInfo", {{"threadId", 1}});
  EXPECT_EQ(info.at("exceptionId"), "E160");
  EXPECT_EQ(info.at("description"), "the machine's X leaves its travel: it goes to 130, and the travel ends at 100");
  EXPECT_EQ(client.run("continue").at("text"), "E160");
  EXPECT_EQ(client.line(), 5);
}

/// The run takes VGPL and registers as the launch gives them, and comments silence it.
TEST(Breakpoints, FindingsOfTheMachineFollowTheLaunch) {
  const char* const program =
      "M06 T101001\nIF VGPL = 1 GOTO N10\nG00 X130\nM02\nN10 G00 X131 ;isolint: ignore E160\nX30\nX40\nX132\nM02\n";
  DebugClient client;
  client.write("isocnc.json", kLimitedMachine);
  client.launch(program, {{"vgpl", 1}});
  client.request("setExceptionBreakpoints", {{"filters", {"run"}}});
  EXPECT_EQ(client.run("configurationDone").at("text"), "E160");
  EXPECT_EQ(client.line(), 8);
  client.request("continue");
  client.event("terminated");
  EXPECT_FALSE(client.has_event("stopped"));
}

TEST(Breakpoints, FiltersStopTheRunWhereTheirConditionHolds) {
  DebugClient client;
  client.write("isocnc.json", kLimitedMachine);
  client.launch(kOutsideProgram);
  const auto set = [&](const std::string& filter, const std::string& condition) {
    const Json options = Json::array({{{"filterId", filter}, {"condition", condition}}});
    return client.request("setExceptionBreakpoints", {{"filters", Json::array()}, {"filterOptions", options}})
        .at("breakpoints")[0];
  };
  EXPECT_EQ(set("errors", "X > 1").at("verified"), false);
  EXPECT_THAT(set("errors", "X > 1").at("message").get<std::string>(), HasSubstr("errors"));
  EXPECT_EQ(set("run", "X >").at("verified"), false);
  EXPECT_EQ(set("run", "X = 40").at("verified"), true);
  EXPECT_EQ(client.run("configurationDone").at("text"), "E160");
  EXPECT_EQ(client.line(), 5);
  set("toolChange", "T = 7");
  client.set_lines({10});
  EXPECT_EQ(client.run("continue").at("reason"), "breakpoint");
  set("run", "X = 40");
  client.set_lines({});
  EXPECT_EQ(client.run("reverseContinue").at("reason"), "exception");
  EXPECT_EQ(client.line(), 5);
}

/// docs/motion.md, "Where the tip is": home is where the spindle nose stands, and M06 moves no joint.
constexpr const char* kTallMachine = R"({"machine": {
    "home": {"z": 450}, "axes": {"X": {"min": -100, "max": 100}, "Z": {"min": 0, "max": 460}},
    "tools": [{"head": 1, "holder": 1, "tool": 1, "length": 100, "radius": 8},
              {"head": 1, "holder": 2, "tool": 1, "length": 40}]}})";

/// Lines at which the filter of axis limits stops a run, forward and then backward from the line `end`.
Stops stops_at_limits(const std::string& program, int end) {
  DebugClient client;
  client.write("isocnc.json", kTallMachine);
  client.launch(program);
  client.request("setExceptionBreakpoints", {{"filters", {"limits"}}});
  return stops_before(client, end);
}

TEST(Breakpoints, TravelIsThatOfTheMachineAfterAToolChange) {
  const Stops stops = stops_at_limits(
      "M06 T101001\n"
      "G00 X50\n"       // 2: the nose stays at Z450, where the program has it at Z550.
      "G00 Z400\n"      // 3: the nose would go to Z500.
      "G00 Z350\n"      // 4: it comes back from there.
      "M06 T102001\n"   // 5: the nose stays at Z450, and the tip of the shorter tool is at Z410.
      "G00 X60\n"       // 6
      "G91 G00 Z60\n"   // 7: the nose would go to Z510, where the program has it at Z450.
      "G90 G00 Z350\n"  // 8: it comes back from there.
      "M02\n",
      9);
  EXPECT_THAT(stops.on, ElementsAre(3, 4, 7, 8));
  EXPECT_THAT(stops.back, ElementsAre(8, 7, 4, 3));
}

/// The tool of 8 mm radius goes to X103, where the contour is at X95.
TEST(Breakpoints, TravelIsThatOfTheMachineBesideAContour) {
  const Stops stops = stops_at_limits(
      "M06 T101001\n"
      "G00 X0 Y0 Z5\n"
      "G42 G01 X50 Y10 F6000\n"
      "X95\n"     // 4
      "Y50\n"     // 5
      "X50\n"     // 6
      "X0 G40\n"  // 7
      "M02\n",
      8);
  EXPECT_THAT(stops.on, ElementsAre(4, 5));
  EXPECT_THAT(stops.back, ElementsAre(5, 4));
}

TEST(Breakpoints, LocationsAreLinesThatDoSomething) {
  DebugClient client;
  client.launch(kPart);
  std::vector<int> lines;
  for (const Json& each :
       Json(client
                .request("breakpointLocations",
                         {{"source", {{"path", client.program().string()}}}, {"line", 1}, {"endLine", 8}})
                .at("breakpoints")))
    lines.push_back(each.at("line"));
  EXPECT_THAT(lines, ElementsAre(2, 3, 4, 5, 7, 8));
}

}  // namespace
}  // namespace isocnc::debugger
