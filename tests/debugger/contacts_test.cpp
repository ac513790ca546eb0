// Where the machine touches what surrounds it: the run stops there, forward and backward, inside the block.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "debug_client.h"
#include "interpreter/configuration/configurations.h"
#include "interpreter/configuration/scenes.h"
#include "interpreter/verification/verified_run.h"
#include "tests/support/random.h"
#include "tests/support/text_of_file.h"

namespace isocnc::debugger {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// A place at which a run has stopped.
struct Moment {
  int line = 0;
  double time = 0;
  std::string code;

  friend bool operator==(const Moment& a, const Moment& b) {
    return a.line == b.line && a.time == b.time && a.code == b.code;
  }
  friend void PrintTo(const Moment& moment, std::ostream* out) {
    *out << fmt::format("line {} at {} s: {}", moment.line, moment.time, moment.code);
  }
};

Moment moment_of(DebugClient& client, const Json& stopped) {
  return {.line = client.line(),
          .time = std::stod(client.evaluate("TIME,12")),
          .code = stopped.value("text", stopped.at("reason").get<std::string>())};
}

/// Waits until the program stops or ends; the moment of a stop.
std::optional<Moment> next_stop(DebugClient& client) {
  while (!client.has_event("stopped") && !client.has_event("terminated")) std::this_thread::yield();
  if (!client.has_event("stopped")) return std::nullopt;
  return moment_of(client, client.event("stopped"));
}

void turn_on(DebugClient& client, const std::string& condition = "") {
  Json option = {{"filterId", "contacts"}};
  if (!condition.empty()) option["condition"] = condition;
  const Json answer =
      client.request("setExceptionBreakpoints", {{"filters", Json::array()}, {"filterOptions", {option}}});
  EXPECT_EQ(answer.at("breakpoints").at(0).at("verified"), true) << answer;
}

/// The moments at which a run stops before its last line, in which there is an M02, forward and backward.
struct Moments {
  std::vector<Moment> on;
  std::vector<Moment> back;
};

Moments moments_of(DebugClient& client, int last_line) {
  Moments moments;
  client.set_lines({last_line});
  client.request("configurationDone");
  for (auto stop = next_stop(client); stop && stop->code != "breakpoint"; stop = next_stop(client)) {
    moments.on.push_back(*stop);
    client.request("continue");
  }
  EXPECT_EQ(client.line(), last_line);
  client.set_lines({});
  for (Json stopped = client.run("reverseContinue"); stopped.at("reason") != "entry";
       stopped = client.run("reverseContinue"))
    moments.back.push_back(moment_of(client, stopped));
  std::reverse(moments.back.begin(), moments.back.end());
  return moments;
}

int line_count(const std::string& text) { return static_cast<int>(std::count(text.begin(), text.end(), '\n')); }

/// A three-axis machine with a cutter of 10 mm radius that is 60 mm long, and three posts on the table.
constexpr const char* kMachine = R"({
  "machine": {
    "home": {"z": 300},
    "tools": [{"head": 1, "holder": 1, "tool": 1, "length": 100, "radius": 10, "shape": "flat", "cutLength": 60},
              {"head": 1, "holder": 1, "tool": 2, "length": 140, "radius": 10, "shape": "flat", "cutLength": 60},
              {"head": 1, "holder": 1, "tool": 3, "radius": 10}]},
  "setups": [{"paths": ["*.iso"], "clearance": 0, "fixtures": [
    {"name": "post 1", "box": [[100, -20, 0], [120, 20, 50]]},
    {"name": "post 2", "box": [[200, -20, 0], [220, 20, 50]]},
    {"name": "post 3", "box": [[300, -20, 0], [320, 20, 30]]}]}]})";

/// Through the first two posts in one block, into the third one from above in two, and out again.
constexpr const char* kProgram =
    "M06 T101001\n"
    "S12000 M03\n"
    "G00 X0 Y0 Z60\n"
    "Z20\n"
    "G01 X250 F6000\n"  // 5
    "G00 Z60\n"
    "X310\n"
    "G01 Z25 F3000\n"  // 8
    "Z20\n"
    "G00 Z60\n"
    "M02\n";

class Contacts : public testing::Test {
 protected:
  void launch(const std::string& program, const char* machine = kMachine) {
    client.write("isocnc.json", machine);
    client.launch(program);
  }

  DebugClient client;
};

TEST_F(Contacts, StopTheRunInsideTheBlock) {
  launch(kProgram);
  turn_on(client);
  const Json stopped = client.run("configurationDone");
  EXPECT_EQ(stopped.at("reason"), "exception");
  EXPECT_EQ(stopped.at("text"), "E152");
  EXPECT_EQ(client.line(), 5);
  EXPECT_NEAR(std::stod(client.evaluate("X,9")), 90, 0.02);
  const Json info = client.request("exceptionInfo", {{"threadId", 1}});
  EXPECT_EQ(info.at("exceptionId"), "E152");
  EXPECT_THAT(info.at("description").get<std::string>(), HasSubstr("post 1"));
  EXPECT_THAT(info.at("description").get<std::string>(), HasSubstr("the cutter of T101001"));
  EXPECT_THAT(info.at("details").at("stackTrace").get<std::string>(), HasSubstr("E152"));
}

TEST_F(Contacts, AreToldInTheUnitOfTheirBlock) {
  launch("M06 T101001\nS12000 M03\nG70\nG00 X0 Y0 Z2.4\nZ0.7874\nG01 X10 F200\nM02\n");
  turn_on(client);
  client.run("configurationDone");
  const Json info = client.request("exceptionInfo", {{"threadId", 1}});
  EXPECT_THAT(info.at("description").get<std::string>(), HasSubstr("hits post 1: 0.7874 in deep at X"));
}

TEST_F(Contacts, StopEachOnceForwardAndBackward) {
  launch(kProgram);
  turn_on(client);
  const Moments moments = moments_of(client, 11);
  std::vector<int> lines;
  for (const Moment& each : moments.on) lines.push_back(each.line);
  EXPECT_THAT(lines, ElementsAre(5, 5, 8));
  EXPECT_EQ(moments.on, moments.back);
}

TEST_F(Contacts, StopAStepOverTheBlock) {
  launch(kProgram, kMachine);
  turn_on(client);
  client.set_lines({5});
  client.run("configurationDone");
  for (const int x : {90, 190}) {
    EXPECT_EQ(client.run("next").at("reason"), "exception");
    EXPECT_EQ(client.line(), 5);
    EXPECT_NEAR(std::stod(client.evaluate("X,9")), x, 0.02);
  }
  EXPECT_EQ(client.run("next").at("reason"), "step");
  EXPECT_EQ(client.line(), 6);
  EXPECT_EQ(client.run("stepBack").at("reason"), "step");
  EXPECT_EQ(client.line(), 5);
  EXPECT_EQ(client.evaluate("X"), "0");
  EXPECT_EQ(client.run("stepIn").at("reason"), "step");
  EXPECT_EQ(client.run("stepIn").at("reason"), "exception");
  EXPECT_NEAR(std::stod(client.evaluate("X,9")), 90, 0.02);
  EXPECT_EQ(client.run("stepBack").at("reason"), "step");
  EXPECT_EQ(client.evaluate("X"), "0");
}

/// The longer tool stands in the post as soon as it is mounted; what moves it next is the contact.
TEST_F(Contacts, OfAToolThatIsMountedInAnObstacleBelongToTheNextMotion) {
  launch(
      "M06 T101001\n"
      "G00 X110 Y0 Z80\n"
      "M06 T101002\n"
      "M100\n"
      "G00 Z110\n"
      "M06 T101002\n"
      "G00 X0\n"
      "M02\n");
  turn_on(client);
  const Moments moments = moments_of(client, 8);
  ASSERT_EQ(moments.on.size(), 1u);
  EXPECT_EQ(moments.on[0].line, 5);
  EXPECT_EQ(moments.on, moments.back);
}

/// After a tool whose length is not known it is not known where the next one is, until Z has a coordinate.
TEST_F(Contacts, AreNoneWhereItIsNotKnownWhereTheToolIs) {
  launch(
      "M06 T101003\n"
      "G00 X110 Y0 Z20\n"
      "M06 T101001\n"
      "G00 X210\n"
      "Z80\n"
      "X310\n"
      "Z20\n"  // 7
      "M02\n");
  turn_on(client);
  client.set_lines({5, 6});
  client.run("configurationDone");
  EXPECT_EQ(client.line(), 5);
  EXPECT_EQ(client.evaluate("CLEARANCE"), "-");
  EXPECT_EQ(client.evaluate("DEPTH"), "-");
  EXPECT_TRUE(client.variables("Surroundings").size() == 2u);
  EXPECT_EQ(client.run("continue").at("reason"), "breakpoint");
  EXPECT_NEAR(std::stod(client.evaluate("CLEARANCE,9")), 30, 0.02);
  EXPECT_EQ(client.run("continue").at("text"), "E152");
  EXPECT_EQ(client.line(), 7);
  EXPECT_EQ(client.run("reverseContinue").at("reason"), "breakpoint");
  EXPECT_EQ(client.line(), 6);
  EXPECT_EQ(client.run("reverseContinue").at("reason"), "breakpoint");
  EXPECT_EQ(client.evaluate("CLEARANCE"), "-");
  EXPECT_EQ(client.run("reverseContinue").at("reason"), "entry");
}

/// What is changed by hand does not tell where it is, nor hide it.
TEST_F(Contacts, AreNoneUntilZHasACoordinateAfterAChangeByHandAsWell) {
  launch("M06 T101003\nG00 X150 Y0 Z20\nM06 T101001\nG00 X310\nZ20\nX330\nM02\n");
  turn_on(client);
  client.set_lines({5});
  client.run("configurationDone");
  client.request("setExpression", {{"expression", "OVERRIDE"}, {"value", "50"}});
  EXPECT_EQ(client.evaluate("CLEARANCE"), "-");
  EXPECT_EQ(client.run("continue").at("text"), "E152");
  EXPECT_EQ(client.line(), 6);
}

/// What does not hang on the spindle is compared wherever that is: its contact stops the run once.
TEST_F(Contacts, OfWhatIsNotOnTheSpindleStopOnceWhereThatIsNotKnown) {
  launch("M06 T101003\nG00 Z250\nB-40\nX8\nX10\nX12\nM02\n", R"({
    "machine": {"home": {"z": 400}, "kinematics": {"type": "table", "bPoint": {"z": -50}},
      "tools": [{"head": 1, "holder": 1, "tool": 3, "radius": 10}],
      "bodies": [{"name": "rail", "on": "machine", "box": [[60, -90, -80], [100, 90, -20]]}]},
    "setups": [{"paths": ["*.iso"], "clearance": 0, "fixtures": [
      {"name": "clamp", "box": [[60, -20, 0], [80, 20, 40]]}]}]})");
  turn_on(client);
  const Moments moments = moments_of(client, 7);
  ASSERT_EQ(moments.on.size(), 1u);
  EXPECT_EQ(moments.on[0].line, 3);
  EXPECT_EQ(moments.on, moments.back);
}

TEST_F(Contacts, CanHaveAConditionThatIsJudgedThere) {
  struct Case {
    const char* condition;
    std::vector<int> lines;
  };
  for (const Case& each :
       {Case{"X > 150", {5, 8}}, Case{"TIME > 0 && X < 100", {5}}, Case{"Z > 29", {8}}, Case{"T = 101002", {}}}) {
    DebugClient another;
    another.write("isocnc.json", kMachine);
    another.launch(kProgram);
    turn_on(another, each.condition);
    const Moments moments = moments_of(another, 11);
    std::vector<int> lines;
    for (const Moment& moment : moments.on) lines.push_back(moment.line);
    EXPECT_EQ(lines, each.lines) << each.condition;
    EXPECT_EQ(moments.on, moments.back) << each.condition;
  }
}

/// What is changed by hand counts: a block of the console, a register, the override.
TEST_F(Contacts, AreThoseOfTheRunAsItIsNow) {
  launch("M06 T101001\nG00 X0 Y0 Z60\nIF V1 = 1 GOTO N10\nM02\nN10 G01 X150 F6000\nX250\nM02\n");
  turn_on(client);
  client.set_lines({3});
  client.run("configurationDone");
  client.evaluate("G00 Z20", "repl");
  client.request("setExpression", {{"expression", "V1"}, {"value", "1"}});
  client.request("setExpression", {{"expression", "OVERRIDE"}, {"value", "50"}});
  EXPECT_EQ(client.run("continue").at("text"), "E152");
  EXPECT_EQ(client.line(), 5);
  EXPECT_EQ(client.run("continue").at("text"), "E152");
  EXPECT_EQ(client.line(), 6);
}

/// A change by hand while the tool is in an obstacle is no other contact.
TEST_F(Contacts, GoOnOverAChangeByHand) {
  launch("M06 T101001\nG00 X0 Y0 Z20\nG01 X110 F6000\nX150\nX250\nM02\n");
  turn_on(client);
  EXPECT_EQ(client.run("configurationDone").at("text"), "E152");
  client.run("next");
  EXPECT_EQ(client.line(), 4);
  client.request("setExpression", {{"expression", "F"}, {"value", "3000"}});
  EXPECT_EQ(client.run("continue").at("text"), "E152");
  EXPECT_EQ(client.line(), 5);
}

TEST_F(Contacts, WithoutASceneNeverStopARun) {
  launch(kProgram, R"({"machine": {}})");
  turn_on(client);
  client.request("configurationDone");
  client.event("terminated");
  EXPECT_FALSE(client.has_event("stopped"));
}

TEST_F(Contacts, ReportWhatIsWrongWithTheirSetup) {
  client.write("program.setup.json", R"({"fixtures": [{"name": "a", "mesh": "missing.stl"}]})");
  launch(kProgram);
  turn_on(client);
  client.request("configurationDone");
  Json output = client.event("output");
  while (output.at("category") != "important") output = client.event("output");
  EXPECT_THAT(output.at("output").get<std::string>(), HasSubstr("missing.stl"));
  client.event("terminated");
}

TEST_F(Contacts, AreOffWithoutDebugging) {
  client.write("isocnc.json", kMachine);
  client.launch(kProgram, {{"noDebug", true}});
  turn_on(client);
  client.request("configurationDone");
  client.event("terminated");
  EXPECT_FALSE(client.has_event("stopped"));
}

using Surroundings = Contacts;

TEST_F(Surroundings, ListObstaclesNearestFirst) {
  launch("M06 T101001\nG92 X5 Y0 Z0\nG00 X55 Y0 Z20\nM100\nG01 X100 F1000\nM02\n");
  client.set_lines({5});
  client.run("configurationDone");
  // The setup is in the workpiece frame: the edge of the cutter is at X65 there.
  EXPECT_EQ(client.variable("Surroundings", "CLEARANCE"), "35");
  EXPECT_EQ(client.variable("Surroundings", "DEPTH"), "0");
  EXPECT_EQ(client.evaluate("CLEARANCE"), "35");
  std::vector<std::string> all;
  for (const Json& each : client.variables("Surroundings"))
    all.push_back(each.at("name").get<std::string>() + "=" + each.at("value").get<std::string>());
  EXPECT_THAT(all, ElementsAre("CLEARANCE=35", "DEPTH=0", "post 1=35 mm", "post 2=135 mm", "post 3=235 mm"));
  client.set_lines({6});
  client.run("continue");
  EXPECT_EQ(client.evaluate("DEPTH"), "10");
  EXPECT_EQ(client.evaluate("DEPTH > 1 && CLEARANCE < 0"), "1");
  EXPECT_EQ(client.variable("Surroundings", "post 1"), "hit, 10 mm deep");
  std::vector<std::string> below = client.below("Surroundings", "post 1");
  ASSERT_EQ(below.size(), 5u);
  EXPECT_EQ(below[0], "Part=the cutter of T101001");
  EXPECT_EQ(below[1], "Distance=0");
  EXPECT_EQ(below[2], "Depth=10");
  EXPECT_THAT(below[3], testing::StartsWith("Point=X 100 Y"));
  EXPECT_THAT(below[4], testing::EndsWith("isocnc.json:8"));
  EXPECT_THAT(client.refusal("variables", {{"variablesReference", 2003}}), HasSubstr("2003"));
}

TEST_F(Surroundings, AreNotShownWithoutAScene) {
  launch(kProgram, R"({"machine": {}})");
  client.set_lines({3});
  client.run("configurationDone");
  EXPECT_THROW(client.variables("Surroundings"), std::runtime_error);
  EXPECT_EQ(client.evaluate("CLEARANCE"), "-");
  EXPECT_EQ(client.evaluate("DEPTH >= 0"), "0");
}

/// In the condition of the filter, DEPTH is how deep the contact gets in the block; one that goes on from the block
/// before stops the run where it is deepest, as line 9 ends.
TEST_F(Surroundings, MayBeAConditionOfContacts) {
  for (const auto& [condition, line] :
       {std::pair("DEPTH > 4.5 && DEPTH < 9", 8), std::pair("DEPTH > 8 && DEPTH < 12", 9)}) {
    DebugClient another;
    another.write("isocnc.json", kMachine);
    another.launch(kProgram);
    turn_on(another, condition);
    const Moments moments = moments_of(another, 11);
    ASSERT_EQ(moments.on.size(), 1u) << condition;
    EXPECT_EQ(moments.on[0].line, line) << condition;
    EXPECT_EQ(moments.on, moments.back) << condition;
  }
}

TEST_F(Surroundings, CountInConditionsAndMessages) {
  launch(kProgram);
  client.set_breakpoints({{{"line", 4}, {"logMessage", "{CLEARANCE,1} mm"}},
                          {{"line", 5}, {"condition", "CLEARANCE > 90.5"}},
                          {{"line", 6}, {"condition", "DEPTH = 0 && CLEARANCE < 80"}}});
  client.run("configurationDone");
  EXPECT_EQ(client.line(), 6);
  Json output = client.event("output");
  while (output.at("category") != "console") output = client.event("output");
  EXPECT_EQ(output.at("output"), "90.6 mm\n");
}

void watch(DebugClient& client, const std::vector<std::string>& limits) {
  Json breakpoints = Json::array();
  for (const std::string& limit : limits) {
    EXPECT_EQ(client.request("dataBreakpointInfo", {{"name", limit}}).at("dataId"), limit);
    breakpoints.push_back({{"dataId", limit}});
  }
  for (const Json& each : Json(client.request("setDataBreakpoints", {{"breakpoints", breakpoints}}).at("breakpoints")))
    EXPECT_EQ(each.at("verified"), true) << each;
}

struct LimitCase {
  std::string limit;
  std::vector<std::string> places;  ///< Lines, and what is left of them: `5 X85`.
};

class Limits : public testing::TestWithParam<LimitCase> {};

TEST_P(Limits, StopTheRunWhereTheyBeginToHold) {
  DebugClient client;
  client.write("isocnc.json", kMachine);
  client.launch(kProgram);
  watch(client, {GetParam().limit});
  client.set_lines({11});
  client.request("configurationDone");
  std::vector<std::string> places;
  std::vector<Moment> on;
  for (auto stop = next_stop(client); stop && stop->code != "breakpoint"; stop = next_stop(client)) {
    EXPECT_EQ(stop->code, "data breakpoint");
    on.push_back(*stop);
    places.push_back(fmt::format("{} X{} Z{}", client.line(), client.evaluate("X,2"), client.evaluate("Z,2")));
    EXPECT_EQ(client.evaluate(GetParam().limit), "1");
    client.request("continue");
  }
  EXPECT_EQ(places, GetParam().places);
  client.set_lines({});
  std::vector<Moment> back;
  for (Json stopped = client.run("reverseContinue"); stopped.at("reason") != "entry";
       stopped = client.run("reverseContinue"))
    back.push_back(moment_of(client, stopped));
  std::reverse(back.begin(), back.end());
  EXPECT_EQ(on, back);
}

INSTANTIATE_TEST_SUITE_P(
    All, Limits,
    testing::Values(LimitCase{"CLEARANCE < 5", {"5 X85.00 Z20.00", "5 X185.00 Z20.00", "8 X310.00 Z35.00"}},
                    LimitCase{"CLEARANCE <= 1", {"5 X89.00 Z20.00", "5 X189.00 Z20.00", "8 X310.00 Z31.00"}},
                    LimitCase{"DEPTH > 8", {"5 X98.00 Z20.00", "5 X198.00 Z20.00", "9 X310.00 Z22.00"}},
                    LimitCase{"DEPTH < 3", {"5 X127.00 Z20.00", "5 X227.00 Z20.00", "10 X310.00 Z27.00"}},
                    LimitCase{"CLEARANCE > 25", {"5 X155.00 Z20.00", "7 X252.91 Z60.00", "10 X310.00 Z55.00"}}));

TEST_F(Surroundings, AreWatchedAtALimitAlone) {
  launch(kProgram);
  for (const char* const wrong :
       {"CLEARANCE", "CLEARANCE = 5", "CLEARANCE < V3", "CLEARANCE < 5 && X > 1", "DEPTH + 1", "CLEARANCE < 1/0"}) {
    EXPECT_TRUE(client.request("dataBreakpointInfo", {{"name", wrong}}).at("dataId").is_null()) << wrong;
    EXPECT_EQ(client.request("setDataBreakpoints", {{"breakpoints", {{{"dataId", wrong}}}}})
                  .at("breakpoints")[0]
                  .at("verified"),
              false)
        << wrong;
  }
}

/// A longer tool comes nearer as soon as it is mounted: the run stops after the M06.
TEST_F(Surroundings, AreWatchedOverAToolChange) {
  launch("M06 T101001\nG00 X110 Y0 Z95\nM06 T101002\nM100\nM02\n");
  watch(client, {"CLEARANCE < 20"});
  const Json stopped = client.run("configurationDone");
  EXPECT_EQ(stopped.at("reason"), "data breakpoint");
  EXPECT_EQ(stopped.at("description"), "CLEARANCE < 20");
  EXPECT_EQ(client.line(), 4);
  client.set_lines({5});
  client.run("continue");
  EXPECT_EQ(client.line(), 5);
  EXPECT_EQ(client.run("reverseContinue").at("reason"), "data breakpoint");
  EXPECT_EQ(client.line(), 4);
  EXPECT_EQ(client.run("reverseContinue").at("reason"), "entry");
}

TEST_F(Surroundings, OfALimitMayBeLoggedAndCounted) {
  launch(kProgram);
  client.request(
      "setDataBreakpoints",
      {{"breakpoints",
        {{{"dataId", "CLEARANCE < 5"}, {"condition", "X > 150"}}, {{"dataId", "DEPTH > 1"}, {"hitCondition", "2"}}}}});
  EXPECT_EQ(client.run("configurationDone").at("description"), "CLEARANCE < 5");
  EXPECT_EQ(client.evaluate("X,2"), "185.00");
  EXPECT_EQ(client.run("next").at("reason"), "step");
  client.run("continue");
  EXPECT_EQ(client.line(), 8);
}

/// The contacts of a verification.
std::vector<verification::Contact> verified_contacts(const std::filesystem::path& file) {
  configuration::Configurations configurations({}, dialect::Language::English);
  const configuration::Configuration configuration = configurations.in_folder(file.parent_path());
  configuration::Scenes scenes(dialect::Language::English);
  const auto scene = scenes.of(configuration, file);
  running::RunOptions options;
  options.setup = configuration.machine.setup;
  auto contacts =
      verification::verified_run(text_of_file(file), options, configuration.machine.timed, scene.get()).contacts;
  std::erase_if(contacts, [](const verification::Contact& contact) {
    return contact.is_near_miss() || dialect::definition(contact.id).severity != dialect::Severity::Error;
  });
  return contacts;
}

/// Launches a program where it is.
void launch_file(DebugClient& client, const std::filesystem::path& file) {
  client.request("initialize", {{"adapterID", "isocnc"}});
  client.request("launch", {{"program", file.string()}});
  client.event("initialized");
}

/// The contacts that a verification lists are the moments at which the run stops.
TEST(ContactsOfExamples, AreTheMomentsAtWhichARunStops) {
  int contacts = 0;
  int of_material = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(ISOCNC_SOURCE_DIR "/examples")) {
    const std::filesystem::path& file = entry.path();
    if (file.extension() != ".iso") continue;
    const std::vector<verification::Contact> expected = verified_contacts(file);
    DebugClient client;
    launch_file(client, file);
    turn_on(client);
    client.request("configurationDone");
    for (const verification::Contact& contact : expected) {
      const auto stop = next_stop(client);
      ASSERT_TRUE(stop) << file;
      EXPECT_EQ(stop->line, static_cast<int>(contact.line) + 1) << file;
      EXPECT_NEAR(stop->time, contact.time, 1e-6) << file;
      EXPECT_EQ(stop->code, dialect::definition(contact.id).code) << file;
      if (contact.is_of_material) ++of_material;
      client.request("continue");
      ++contacts;
    }
    if (const auto more = next_stop(client)) ADD_FAILURE() << file << " stops again: " << more->line;
  }
  EXPECT_GE(contacts, 6);
  EXPECT_GE(of_material, 1);
}

/// A machine of each kind of kinematics, with posts around the paths of random programs.
std::string machine_of_kind(const std::string& kind) {
  return fmt::format(R"({{
    "machine": {{
      "home": {{"z": 400}}, "kinematics": {{"type": "{}"{}}},
      "tools": [{{"head": 1, "holder": 1, "tool": 1, "length": 80, "radius": 3, "shape": "flat",
                 "cutLength": 40}},
                {{"head": 1, "holder": 1, "tool": 2, "length": 120, "radius": 8, "shape": "flat", "cutLength": 40}}],
      "nose": [[60, 80, 80]]}},
    "setups": [{{"paths": ["*.iso"], "fixtures": [
      {{"name": "post 1", "box": [[20, -20, -200], [30, 20, 30]]}},
      {{"name": "post 2", "box": [[-60, -90, -200], [-40, -60, 5]]}},
      {{"name": "post 3", "cylinder": {{"at": [50, 50, -100], "height": 130, "diameter": 30}}}},
      {{"name": "post 4", "box": [[-90, 10, -100], [-20, 60, 1]]}}]}}]}})",
                     kind,
                     kind == "three-axis" ? ""
                     : kind == "head"     ? R"(, "pivot": 150)"
                                          : "");
}

std::string random_program(support::Random& random, bool turns) {
  const auto number = [&] { return random.between(-900, 900) / 10.0; };
  std::string text = "M06 T101001\nS12000 M03\nG00 X0 Y0 Z60\n";
  int radius = 0;
  for (int i = 0; i < 25; ++i) {
    switch (random.between(0, turns ? 7 : 5)) {
      case 0:
        text += fmt::format("G00 X{} Y{}\n", number(), number());
        break;
      case 1:
        text += fmt::format("G00 Z{}\n", random.between(-10, 80));
        break;
      case 2:
        radius = random.between(5, 40);
        text += fmt::format("G91 G03 X{} Y0 I{} J0 F6000\nG90\n", 2 * radius, radius);
        break;
      case 3:
        text += fmt::format("M06 T10100{}\n", random.between(1, 2));
        break;
      case 4:
        text += fmt::format("G41\nG01 X{} Y{} F4000\nX{}\nY{}\nG40\nG01 X{} Y{}\n", number(), number(), number(),
                            number(), number(), number());
        break;
      case 5:
        text += fmt::format("G01 X{} Y{} Z{} F5000\n", number(), number(), random.between(-5, 40));
        break;
      case 6:
        text += fmt::format("G00 B{} C{}\n", random.between(-60, 60), random.between(-90, 90));
        break;
      default:
        text += fmt::format("G49\nG01 X{} B{} C{} F3000\nG48\n", number(), random.between(-60, 60),
                            random.between(-90, 90));
    }
  }
  return text + "G00 Z90\nM02\n";
}

class ContactsOfKinematics : public testing::TestWithParam<const char*> {};

TEST_P(ContactsOfKinematics, AreTheSameForwardAndBackward) {
  std::size_t count = 0;
  for (const std::uint64_t seed : support::seeds(12)) {
    support::Random random(seed);
    const std::string program = random_program(random, std::string(GetParam()) != "three-axis");
    DebugClient client;
    client.write("isocnc.json", machine_of_kind(GetParam()));
    client.launch(program);
    turn_on(client);
    const Moments moments = moments_of(client, line_count(program));
    EXPECT_EQ(moments.on, moments.back) << program;
    count += moments.on.size();
    if (HasFailure()) return;
  }
  if (support::kTriesAll) {
    EXPECT_GE(count, 30u);
  }
}

INSTANTIATE_TEST_SUITE_P(All, ContactsOfKinematics, testing::Values("three-axis", "head", "table"));

}  // namespace
}  // namespace isocnc::debugger
