#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <utility>

#include <nlohmann/json.hpp>

#include "programs.h"
#include "run_command.h"
#include "temporary_folder.h"

namespace isocnc::commands {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::MatchesRegex;
using testing::StartsWith;

std::vector<json> events_in(const std::string& trace) {
  std::vector<json> events;
  std::istringstream lines(trace);
  for (std::string line; std::getline(lines, line);) events.push_back(json::parse(line));
  return events;
}

std::vector<std::string> kinds_in(const std::vector<json>& events) {
  std::vector<std::string> kinds;
  for (const json& event : events) kinds.push_back(event.at("kind"));
  return kinds;
}

/// Without its time.
json timeless(json event) {
  event.erase("start");
  event.erase("duration");
  return event;
}

/// Runs a program from standard input and returns its trace.
std::vector<json> trace_of(std::string_view program, std::vector<std::string> options = {}) {
  options.insert(options.begin(), {"isorun", "--trace", "-", "-"});
  return events_in(run_command(options, {.input = std::string(program)}).out);
}

std::set<std::string> keys_of(const json& event) {
  std::set<std::string> keys;
  for (const auto& [key, value] : event.items()) keys.insert(key);
  return keys;
}

/// The keys of each kind of event; `spindle` has a speed or a number.
const std::map<std::string, std::set<std::string>> kKeys = {
    {"rapid", {"line", "kind", "from", "to", "lengthMm", "start", "duration"}},
    {"feed", {"line", "kind", "from", "to", "lengthMm", "feed", "start", "duration"}},
    {"arc",
     {"line", "kind", "from", "to", "center", "normal", "radius", "sweepDeg", "lengthMm", "feed", "start", "duration"}},
    {"dwell", {"line", "kind", "seconds", "start", "duration"}},
    {"tool", {"line", "kind", "head", "holder", "tool"}},
    {"frame", {"line", "kind", "workpiece", "face"}},
    {"jump", {"line", "kind", "taken", "target"}},
    {"update", {"line", "kind"}},
    {"end", {"line", "kind"}},
};

TEST(IsorunTrace, OfEveryExampleHasTheKeysOfEachKind) {
  for (const auto& entry : std::filesystem::directory_iterator(ISOCNC_SOURCE_DIR "/examples")) {
    if (entry.path().extension() != ".iso") continue;
    const CommandResult result = run_command({"isorun", "--trace", "-", entry.path()});
    EXPECT_EQ(result.status, 0) << entry.path() << result.err;
    EXPECT_EQ(result.err, "");
    const std::vector<json> events = events_in(result.out);
    ASSERT_FALSE(events.empty()) << entry.path();
    for (const json& event : events) {
      const auto keys = kKeys.find(event.at("kind"));
      if (keys != kKeys.end()) {
        EXPECT_THAT(keys_of(event), IsSupersetOf(keys->second)) << entry.path() << event;
      }
    }
    EXPECT_EQ(events.back().at("kind"), "end");
  }
}

TEST(IsorunTrace, ReportsWhatHappensInItsOrder) {
  const std::vector<json> events = trace_of(
      "M06 T102003\n"
      "S12000 M03\n"
      "G92 X100 Y200 Z-50\n"
      "G00 X10 Y20 Z5\n"
      "G01 Z-3 F1000\n"
      "G03 X20 Y20 I15 J20\n"
      "G04 P0.5\n"
      "M101 P1=5 P2=-2.5\n"
      "G29 Z10 B90\n"
      "G27\n"
      "M02\n");
  EXPECT_THAT(kinds_in(events), ElementsAre("tool", "spindle", "spindle", "frame", "rapid", "feed", "arc", "dwell", "m",
                                            "frame", "frame", "end"));
  EXPECT_EQ(timeless(events[0]), json::parse(R"({"line": 1, "kind": "tool", "head": 1, "holder": 2, "tool": 3})"));
  EXPECT_EQ(timeless(events[1]), json::parse(R"({"line": 2, "kind": "spindle", "speed": 12000.0})"));
  EXPECT_EQ(timeless(events[2]), json::parse(R"({"line": 2, "kind": "spindle", "number": 3})"));
  EXPECT_EQ(timeless(events[3]),
            json::parse(R"({"line": 3, "kind": "frame", "workpiece": [100.0, 200.0, -50.0], "face": null})"));
  EXPECT_EQ(events[4].at("from"), json::parse("[0.0, 0.0, 0.0, 0.0, 0.0]"));
  EXPECT_EQ(events[4].at("to"), json::parse("[110.0, 220.0, -45.0, 0.0, 0.0]"));
  EXPECT_EQ(events[5].at("lengthMm"), 8.0);
  EXPECT_EQ(events[6].at("center"), json::parse("[115.0, 220.0, -53.0]"));
  EXPECT_EQ(events[6].at("normal"), json::parse("[0.0, 0.0, 1.0]"));
  EXPECT_EQ(events[6].at("radius"), 5.0);
  EXPECT_NEAR(events[6].at("sweepDeg").get<double>(), 180, 1e-9);
  EXPECT_EQ(timeless(events[7]), json::parse(R"({"line": 7, "kind": "dwell", "seconds": 0.5})"));
  EXPECT_EQ(timeless(events[8]),
            json::parse(R"({"line": 8, "kind": "m", "number": 101, "parameters": {"P1": 5.0, "P2": -2.5}})"));
  EXPECT_THAT(keys_of(events[9].at("face")), ElementsAre("i", "j", "k", "origin"));
  EXPECT_EQ(events[9].at("face").at("origin"), json::parse("[0.0, 0.0, 10.0]"));
  EXPECT_EQ(events[10].at("face"), nullptr);
  EXPECT_EQ(timeless(events[11]), json::parse(R"({"line": 11, "kind": "end"})"));
}

TEST(IsorunTrace, ReportsG990) {
  const std::vector<json> events = trace_of("M06 T101001\nG01 X100 F6000\nG990\nX200\nM02\n");
  EXPECT_THAT(kinds_in(events), ElementsAre("tool", "feed", "update", "feed", "end"));
  EXPECT_EQ(timeless(events[2]), json::parse(R"({"line": 3, "kind": "update"})"));
}

TEST(IsorunTrace, ToAFileLeavesTheSummaryOnStandardOutput) {
  const TemporaryFolder folder;
  const std::string trace = folder.path("trace.jsonl");
  const CommandResult result = run_command({"isorun", "--trace", trace, "-"}, {.input = std::string(kCleanProgram)});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.out, StartsWith("result: ran to M02, line 3\n"));
  std::stringstream written;
  written << std::ifstream(trace).rdbuf();
  EXPECT_THAT(kinds_in(events_in(written.str())), ElementsAre("tool", "rapid", "end"));
}

TEST(IsorunTrace, ThatCannotBeWrittenIsAFailure) {
  const auto complaint = [](const std::string& trace) {
    const CommandResult result = run_command({"isorun", "--trace", trace, "-"}, {.input = std::string(kCleanProgram)});
    EXPECT_EQ(result.status, 2) << trace;
    return result.err;
  };
  EXPECT_EQ(complaint("/dev/full"), "isorun: /dev/full: cannot write: No space left on device\n");
  EXPECT_EQ(complaint("/no/such/folder/x"), "isorun: /no/such/folder/x: cannot write: No such file or directory\n");
}

TEST(IsorunSummary, AddsUpWhatWasDone) {
  const CommandResult result = run_command({"isorun", ISOCNC_SOURCE_DIR "/examples/pocket.iso"});
  EXPECT_EQ(result.out,
            "result: ran to M02, line 69\n"
            "cycle time: 46.3 s (rapids 2.4 s, feed moves 18.2 s, arcs 1.7 s, tool changes 16.0 s, spindle 8.0 s)\n"
            "blocks: 63\n"
            "rapids: 8 (1083.213 mm)\n"
            "feed moves: 32 (1559.971 mm), arcs: 14 (138.230 mm)\n"
            "extents (machine): X 0.000..554.000, Y 0.000..354.000, Z -197.500..0.000, B 0.000..0.000, C 0.000..0.000\n"
            "extents (workpiece frame of line 5): X -350.000..204.000, Y -220.000..134.000, Z -12.000..185.500\n"
            "tool T101001: 27.9 s (rapids 1.4 s, feed moves 14.0 s, arcs 0.5 s, tool changes 8.0 s, spindle 4.0 s); "
            "feed moves 1316.237 mm, rapids 800.725 mm\n"
            "tool T102003: 18.3 s (rapids 1.0 s, feed moves 4.2 s, arcs 1.2 s, tool changes 8.0 s, spindle 4.0 s); "
            "feed moves 381.965 mm, rapids 282.488 mm\n"
            "final position (machine): X350.000 Y220.000 Z-155.500 B0.000 C0.000\n"
            "final state: tool T102003, S18000 M05, F4500, G00 G17 G27 G38 G40 G48 G71 G90 G92 G94\n");
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(result.status, 0);
}

json summary_of(const std::string& program, std::vector<std::string> options = {}) {
  options.insert(options.begin(), {"isorun", "--json", "-"});
  return json::parse(run_command(options, {.input = program}).out);
}

TEST(IsorunSummary, IsJsonOnRequest) {
  const json summary = summary_of("M06 T101001\nG01 X100 F6000\nX0\nM06 T101002\nG01 Y10\nM06 T101001\nM02\n");
  EXPECT_EQ(summary.at("file"), "<stdin>");
  EXPECT_EQ(summary.at("result"), "end");
  EXPECT_EQ(summary.at("error"), nullptr);
  EXPECT_EQ(summary.at("feeds").at("count"), 3);
  EXPECT_EQ(summary.at("extents").at("X"), json::parse("[0.0, 100.0]"));
  ASSERT_EQ(summary.at("tools").size(), 2u);
  EXPECT_EQ(summary["tools"][0].at("tool"), "T101001");
  EXPECT_EQ(summary["tools"][0].at("feedMm"), 200);
  EXPECT_EQ(summary["tools"][1].at("feedMm"), 10);
  EXPECT_NEAR(summary["tools"][0].at("seconds").get<double>() + summary["tools"][1].at("seconds").get<double>(),
              summary.at("seconds").get<double>(), 1e-9);
}

TEST(IsorunSummary, ReportsExtentsInEachFrame) {
  const json summary = summary_of(
      "M06 T101001\nG00 X5\nG92 X100 Y200 Z-50\nG00 X10 Y20 Z5\nG29 X50 B90\nG01 X30 Z5 F1000\nG27\nG00 Y40\n"
      "G92 X0\nG29 Z7\nG27\nM02\n");
  const json& frames = summary.at("frames");
  ASSERT_EQ(frames.size(), 2u) << "nothing moved in the others";
  EXPECT_EQ(frames[0].at("line"), 3);
  EXPECT_EQ(frames[0].at("kind"), "workpiece");
  EXPECT_EQ(frames[0].at("origin"), json::parse("[100.0, 200.0, -50.0]"));
  EXPECT_EQ(frames[0].at("extents").at("X"), json::parse("[-95.0, 55.0]"));
  EXPECT_EQ(frames[0].at("extents").at("Y"), json::parse("[-200.0, 40.0]")) << "and again behind G27";
  EXPECT_EQ(frames[1].at("line"), 5);
  EXPECT_EQ(frames[1].at("kind"), "face");
  EXPECT_NEAR(frames[1].at("extents").at("X")[0].get<double>(), -5, 1e-9);
  EXPECT_NEAR(frames[1].at("extents").at("X")[1].get<double>(), 30, 1e-9);
  EXPECT_NEAR(frames[1].at("extents").at("Z")[0].get<double>(), -40, 1e-9);
  EXPECT_EQ(summary.at("framesLeftOut"), 0);
}

TEST(IsorunSummary, KeepsAFewFramesOfMany) {
  std::string program = "M06 T101001\n";
  for (int i = 0; i < 300; ++i) program += "G92 X" + std::to_string(i) + "\nG00 X1\n";
  const json summary = summary_of(program + "M02\n");
  EXPECT_EQ(summary.at("frames").size(), 100u);
  EXPECT_EQ(summary.at("framesLeftOut"), 200);
}

TEST(IsorunSummary, ReportsWhatTheTimeGoesInto) {
  const json summary = summary_of(
      "M06 T101001\nS9000 M03\nG00 X10\nG01 X20 F1000 G09\nG03 X40 I30 J0\nG04 P1.5\nM06 T101002\nG00 X0\nM02\n");
  const json& times = summary.at("times");
  EXPECT_EQ(times.at("dwells"), 1.5);
  EXPECT_EQ(times.at("toolChanges"), 16.0);
  EXPECT_EQ(times.at("spindle"), 2.0);
  EXPECT_EQ(times.at("exactStops"), 0.1);
  EXPECT_EQ(times.at("functions"), 0.0);
  EXPECT_EQ(times.at("rapids"), summary.at("rapids").at("seconds"));
  double sum = 0;
  for (const auto& [work, seconds] : times.items()) {
    sum += seconds.get<double>();
    EXPECT_NEAR(summary["tools"][0]["times"][work].get<double>() + summary["tools"][1]["times"][work].get<double>(),
                seconds, 1e-9)
        << work;
  }
  EXPECT_NEAR(sum, summary.at("seconds"), 1e-9);
}

TEST(IsorunSummary, ReportsTheStateAtTheEnd) {
  const json summary = summary_of("M06 T102003\nS12000 M03\nG01 X10 F4000\nG91 G18\nM02\n");
  EXPECT_EQ(summary.at("finalState"), json::parse(R"({
    "tool": "T102003", "spindle": {"speed": 12000.0, "m": 3}, "feed": 4000.0,
    "modes": ["G01", "G18", "G27", "G38", "G40", "G48", "G71", "G91", "G92", "G94"]})"));
  EXPECT_EQ(summary.at("finalJoints"), json::parse("[10.0, 0.0, 0.0, 0.0, 0.0]"));
  EXPECT_EQ(summary_of("M02\n").at("finalState").at("tool"), nullptr);
  const std::string text =
      run_command({"isorun", "-"}, {.input = "M06 T102003\nS12000 M03\nG00 X10\nM06 T1 01 001\nM02\n"}).out;
  EXPECT_THAT(text, HasSubstr("final state: tool T101001, S12000 M05, G00 G17 G27 G38 G40 G48 G71 G90 G92 G94\n"))
      << "a tool change stops the spindle";
}

TEST(IsorunSummary, FollowsTheTipWhereARapidTurnsB) {
  const json summary = summary_of("M06 T101001\nG00 B90\nM02\n");
  EXPECT_GT(summary.at("rapids").at("lengthMm"), 100) << "the head's pivot swings the tip";
  EXPECT_LT(summary.at("extents").at("Z")[0], -30);
}

/// Also where the tool is longer than the program knows, and where a feed is given as a time.
TEST(IsorunTrace, HasTheLengthsOfTheSummary) {
  const std::string program =
      "M06 T101001\nG00 X10 B90\nG00 B0 Z20\nG01 X50 F4000\nG03 X90 I70 J0 Z5\nG49\nX120 B30 C40\nG93\nG01 Y50 C0 F20\n"
      "G02 X150 R40 B0 F30\nG94\nM06 T101002\nG00 X0\nM02\n";
  const TemporaryFolder folder;
  const std::string machine = folder.write("machine.json", R"({"machine": {"tools": [
    {"head": 1, "holder": 1, "tool": 1, "length": 60}, {"head": 1, "holder": 1, "tool": 2, "length": 90}]}})");
  std::map<std::string, double> sums;
  for (const json& event : trace_of(program, {"--machine", machine}))
    if (event.contains("lengthMm")) sums[event.at("kind")] += event.at("lengthMm").get<double>();
  const json summary = summary_of(program, {"--machine", machine});
  for (const auto& [kind, kinds] : {std::pair("rapid", "rapids"), {"feed", "feeds"}, {"arc", "arcs"}})
    EXPECT_NEAR(sums[kind], summary.at(kinds).at("lengthMm").get<double>(), 1e-6) << kind;
  EXPECT_GT(trace_of("M06 T101001\nG00 B90\nM02\n").at(1).at("lengthMm"), 100) << "the head's pivot swings the tip";
}

TEST(IsorunSummary, KeepsWhatWasDoneBeforeAnError) {
  const json summary = summary_of("M06 T101001\nG01 X100 F6000\nG01\nM02\n");
  EXPECT_EQ(summary.at("result"), "error");
  EXPECT_EQ(summary.at("error").at("code"), "ISO026");
  EXPECT_EQ(summary.at("error").at("line"), 3);
  EXPECT_EQ(summary.at("feeds").at("lengthMm"), 100);
}

/// 60 m/min, 1 m/s^2, a tool of 100 mm: Z of the spindle nose is 100 mm above the tip.
constexpr std::string_view kMachine = R"({"machine": {
  "axes": {"X": {"max": 60, "rapid": 60000, "acceleration": 1000}, "Z": {"max": 120}},
  "times": {"toolChange": 4},
  "tools": [{"head": 1, "holder": 1, "tool": 1, "length": 100}],
  "functions": {"M50": {"time": 3}}}})";

/// The example of docs/machine.md.
TEST(IsorunMachine, TakesAHeadAsItIsMeasured) {
  const TemporaryFolder folder;
  const std::string machine = folder.write("head.json", R"({"machine": {
    "kinematics": {"type": "head", "pivot": 100, "bFromC": {"x": 20}, "spindleFromB": {"y": 7}},
    "tools": [{"head": 1, "holder": 1, "tool": 1, "length": 50}]}})");
  const json joints = summary_of("M06 T101001\nG00 X0 Y0 Z0 C90\nM02\n", {"--machine", machine}).at("finalJoints");
  const double expected[] = {27, -13, 50, 0, 90};
  for (std::size_t axis = 0; axis < 5; ++axis) EXPECT_NEAR(joints[axis], expected[axis], 1e-9) << axis;
}

TEST(IsorunMachine, GivesTimesAndTravel) {
  const TemporaryFolder folder;
  const std::string machine = folder.write("machine.json", kMachine);
  const json summary = summary_of("M06 T101001\nG00 X50\nG03 X50 Y40 R20\nG00 Z30\nM50\nM02\n", {"--machine", machine});
  EXPECT_EQ(summary.at("error").at("code"), "ISO066");
  const json whole =
      summary_of("M06 T101001\nG00 X50\nG03 X50 Y40 R20 F1000\nG00 Z30\nM50\nM02\n", {"--machine", machine});
  // From rest to rest over 50 mm at 1000 mm/s^2, without ever reaching 1000 mm/s.
  EXPECT_NEAR(summary.at("rapids").at("seconds").get<double>(), 2 * std::sqrt(50.0 / 1000), 1e-9);
  ASSERT_EQ(whole.at("outsideTravel").size(), 2u);
  EXPECT_EQ(whole["outsideTravel"][0].at("axis"), "X");
  EXPECT_EQ(whole["outsideTravel"][0].at("line"), 3);
  EXPECT_NEAR(whole["outsideTravel"][0].at("farthest").get<double>(), 70, 1e-6);
  EXPECT_EQ(whole["outsideTravel"][1].at("axis"), "Z");
  EXPECT_EQ(whole["outsideTravel"][1].at("line"), 4);
  EXPECT_NEAR(whole["outsideTravel"][1].at("farthest").get<double>(), 130, 1e-6);
  EXPECT_GT(whole.at("seconds"), 7);
}

TEST(IsorunMachine, OfTheExampleReachesAllThatTheExampleAsksFor) {
  const CommandResult result = run_command({"isorun", "--json", ISOCNC_SOURCE_DIR "/examples/machine/shelf.iso"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(json::parse(result.out).at("outsideTravel"), json::array()) << "with tools of 120 and 95 mm";
}

TEST(IsorunMachine, ReportsWhatIsAskedBeyondItsLimits) {
  const TemporaryFolder folder;
  const std::string machine = folder.write(
      "machine.json", R"({"machine": {"maxFeed": 3000, "maxRotarySpeed": 600, "maxSpindleSpeed": 18000}})");
  const std::string program =
      "M06 T101001\nS18000 M03\nG01 X300 F3000\nX0 F6000\nG93\nX300 F60\nG94\nG49\nB20 F900\nS24000\nM02\n";
  const json summary = summary_of(program, {"--machine", machine});
  EXPECT_EQ(summary.at("aboveLimits"), json::parse(R"([
    {"limit": "feed", "line": 4, "most": 18000.0, "allowed": 3000.0},
    {"limit": "rotarySpeed", "line": 9, "most": 900.0, "allowed": 600.0},
    {"limit": "spindleSpeed", "line": 10, "most": 24000.0, "allowed": 18000.0}])"));
  EXPECT_GT(summary.at("feeds").at("seconds"), 3 * 300.0 / 50 + 2);
  EXPECT_LT(summary.at("feeds").at("seconds"), 3 * 300.0 / 50 + 2.5);
  EXPECT_EQ(summary_of(program).at("aboveLimits"), json::array());
  const std::string text = run_command({"isorun", "--lang", "it", "--machine", machine, "-"}, {.input = program}).out;
  EXPECT_THAT(text, HasSubstr("avanzamento oltre quello della macchina: 18000 mm/min (limite 3000), per la prima volta "
                              "alla riga 4\n"));
}

TEST(IsorunMachine, ReportsHowFarItsTravelIsLeftAndWhereFirst) {
  const TemporaryFolder folder;
  const std::string machine = folder.write("machine.json", R"({"machine": {"axes": {"X": {"min": 0, "max": 100}}}})");
  const std::string program = "M06 T101001\nG00 X150\nX200\nX-5\nX120\nM02\n";
  const std::string text = run_command({"isorun", "--machine", machine, "-"}, {.input = program}).out;
  EXPECT_THAT(text, HasSubstr("outside its travel: X goes to -5.000 (limit 0.000), first on line 4\n"
                              "outside its travel: X goes to 200.000 (limit 100.000), first on line 2\n"
                              "final position"));
}

/// A cutter of 10 mm radius.
constexpr std::string_view kCutter = R"({"machine": {"tools": [{"head": 1, "holder": 1, "tool": 1, "radius": 10}]}})";

/// The entry leads across the contour, and an inside arc is too small.
constexpr std::string_view kGouging =
    "M06 T101001\nG01 X30 Y20 F5000\nG41 G01 X0 Y0\nY45\nG03 X-5 Y50 R5\nG01 X-40\nG40\nM02\n";

TEST(IsorunCompensation, MovesTheTipByTheRadiusOfTheTool) {
  const TemporaryFolder folder;
  const std::string machine = folder.write("machine.json", kCutter);
  const std::string program = "M06 T101001\nG00 Y-30\nG42 G01 X0 Y0 F1000\nX80\nY40\nM02\n";
  const std::vector<json> events = trace_of(program, {"--machine", machine});
  EXPECT_THAT(kinds_in(events), ElementsAre("tool", "rapid", "feed", "feed", "arc", "feed", "end"));
  EXPECT_EQ(events[3].at("to"), json::parse("[80.0, -10.0, 0.0, 0.0, 0.0]"));
  EXPECT_EQ(events[4].at("line"), 4);
  EXPECT_NEAR(events[4].at("sweepDeg").get<double>(), 90, 1e-9);
  EXPECT_EQ(summary_of(program, {"--machine", machine}).at("final"), json::parse("[90.0, 40.0, 0.0, 0.0, 0.0]"));
  EXPECT_EQ(summary_of(program).at("final"), json::parse("[80.0, 40.0, 0.0, 0.0, 0.0]"));
}

TEST(IsorunCompensation, WarnsBesideTheSummary) {
  const TemporaryFolder folder;
  const std::string machine = folder.write("machine.json", kCutter);
  const CommandSetup input{.input = std::string(kGouging)};
  const CommandResult result = run_command({"isorun", "--machine", machine, "-"}, input);
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.err,
            "<stdin>:3: warning: here a cutter of radius 10 mm goes into the contour that it should leave [W138]\n"
            "<stdin>:5: warning: an inside arc of radius 5 mm is too small for a cutter of radius 10 mm [W139]\n");
  EXPECT_THAT(run_command({"isorun", "--lang", "it", "--machine", machine, "-"}, input).err,
              HasSubstr("<stdin>:5: avviso: un arco interno di raggio 5 mm"));
  const json warnings = summary_of(std::string(kGouging), {"--machine", machine}).at("warnings");
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_EQ(warnings[0].at("line"), 3);
  EXPECT_EQ(warnings[0].at("code"), "W138");
  EXPECT_EQ(warnings[1].at("name"), "inside-arc-too-small");
  EXPECT_EQ(summary_of(std::string(kGouging)).at("warnings"), json::array());
}

TEST(IsorunCompensation, OfTheExampleSparesTheContour) {
  const std::string examples = ISOCNC_SOURCE_DIR "/examples";
  const CommandResult result = run_command({"isorun", "--config", examples + "/compensation/isocnc.json", "--trace",
                                            "-", examples + "/contour-compensation.iso"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.err, "");
  std::set<long> radii;
  for (const json& event : events_in(result.out))
    if (event.at("kind") == "arc") radii.insert(std::lround(event.at("radius").get<double>()));
  // The window: 15 and 20 less 8. The panel: 30 and 8 more, the ways on and off it 20 less 8; corners of its own: 8.
  EXPECT_THAT(radii, IsSupersetOf({7L, 12L, 38L}));
}

TEST(IsorunSamples, FollowTheTipInSteps) {
  const std::vector<json> samples = events_in(run_command({"isorun", "--samples", "-", "--dt", "0.05", "-"},
                                                          {.input = "M06 T101001\nG01 X100 F6000\nG04 P1\nX0\nM02\n"})
                                                  .out);
  ASSERT_GT(samples.size(), 100u);
  for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
    EXPECT_NEAR(samples[i].at("t").get<double>(), 0.05 * static_cast<double>(i), 1e-6);
    EXPECT_LE(samples[i].at("speed"), 100.001);
    const double way = samples[i + 1].at("tip").at(0).get<double>() - samples[i].at("tip").at(0).get<double>();
    EXPECT_LE(std::abs(way), 100 * 0.05 + 1e-4);
  }
  EXPECT_EQ(samples.back().at("tip"), json::parse("[0.0, 0.0, 0.0, 0.0, 0.0]"));
  EXPECT_EQ(samples.back().at("speed"), 0.0);
}

/// Home is where the spindle nose is, tool or none; a tool change moves no joint.
TEST(IsorunSamples, BeginAtHomeAndShowTheToolThatIsMounted) {
  const TemporaryFolder folder;
  const std::string machine = folder.write("machine.json", R"({"machine": {
    "home": {"x": 10, "y": 20, "z": 450, "c": 30}, "times": {"toolChange": 1},
    "tools": [{"head": 1, "holder": 1, "tool": 1, "length": 100}]}})");
  const std::vector<json> samples =
      events_in(run_command({"isorun", "--machine", machine, "--samples", "-", "--dt", "0.5", "-"},
                            {.input = "G04 P1\nM06 T101001\nG04 P1\nG00 X50\nM02\n"})
                    .out);
  ASSERT_GT(samples.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(samples[i].at("joints"), json::parse("[10.0, 20.0, 450.0, 0.0, 30.0]")) << i;
    EXPECT_EQ(samples[i].at("tip").at(2), i < 4 ? 450.0 : 350.0) << i;
  }
  EXPECT_EQ(samples.back().at("joints").at(2), 450.0);
  EXPECT_EQ(samples.back().at("tip").at(0), 50.0);
}

/// The SVG of a program.
std::string svg_of(const std::string& program, const std::string& name = "part.iso") {
  const TemporaryFolder folder;
  const std::string plot = folder.path("plot.svg");
  EXPECT_EQ(run_command({"isorun", "--plot", plot, folder.write(name, program)}).status, 0);
  std::stringstream svg;
  svg << std::ifstream(plot).rdbuf();
  return svg.str();
}

TEST(IsorunPlot, IsAPictureOfWhatWasDone) {
  const std::string svg = svg_of("M06 T101001\nG00 X50\nG03 X50 Y40 R20 F1000\nM02\n", "a<b>&.iso");
  EXPECT_THAT(svg, StartsWith("<svg "));
  EXPECT_THAT(svg, HasSubstr("a&lt;b&gt;&amp;.iso</title>"));
  EXPECT_THAT(svg, HasSubstr("d=\"M0.000 -0.000L50.000 -0.000\""));
  EXPECT_THAT(svg, HasSubstr("T101001"));
}

/// A rapid turns B with the axes going straight, so that the tip swings out.
TEST(IsorunPlot, ShowsWhereTheTipGoes) {
  const std::string svg = svg_of("M06 T101001\nG00 X100 B90\nM02\n");
  const std::size_t begin = svg.find("d=\"M0.000 ");
  ASSERT_NE(begin, std::string::npos);
  const std::string path = svg.substr(begin, svg.find("\"/>", begin) - begin);
  EXPECT_GT(std::count(path.begin(), path.end(), 'L'), 10) << path;
}

TEST(IsorunPlot, ShowsStrokesAlongTheViewAsDots) {
  EXPECT_THAT(svg_of("M06 T101001\nG00 X5 Y6\nG01 Z-3 F100\nZ0\nM02\n"),
              HasSubstr("d=\"M5.000 -6.000h0M5.000 -6.000h0"));
  EXPECT_THAT(svg_of("M06 T101001\nG01 Z-3 F100\nM02\n"), HasSubstr("d=\"M0.000 -0.000h0\""));
}

TEST(IsorunPlot, ShowsFramesWithoutMotion) {
  const std::string svg = svg_of("G92 X10 Y20 Z30\nM02\n");
  EXPECT_THAT(svg, HasSubstr("class=\"frame\""));
  EXPECT_THAT(svg, HasSubstr("The program moves nothing."));
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg_of("M02\n").find("class=\"frame\""), std::string::npos);
}

/// Whether this isorun draws HTML; it says why when it does not.
TEST(IsorunPlot, IsAPageOrSaysWhyNot) {
  const TemporaryFolder folder;
  const std::string plot = folder.path("PLOT.HTML");
  const std::string program = folder.write("part.iso", "M06 T101001 ; </script><script>\nG00 X50\nM02\n");
  const CommandResult result = run_command({"isorun", "--plot", plot, program});
  if (result.status == 2) {
    EXPECT_THAT(result.err, HasSubstr("it was built without npm"));
    EXPECT_FALSE(std::filesystem::exists(plot));
    return;
  }
  EXPECT_EQ(result.status, 0);
  std::stringstream page;
  page << std::ifstream(plot).rdbuf();
  EXPECT_THAT(page.str(), StartsWith("<!doctype html>"));
  EXPECT_THAT(page.str(), HasSubstr("<title>part.iso</title>"));
  EXPECT_THAT(page.str(), HasSubstr("Content-Security-Policy"));
  EXPECT_EQ(page.str().find("M06 T101001"), std::string::npos);
}

TEST(IsorunOptions, RefuseWhatMakesNoSense) {
  const auto said = [](std::vector<std::string> options) {
    options.insert(options.begin(), "isorun");
    options.push_back("-");
    const CommandResult result = run_command(options, {.input = std::string(kCleanProgram)});
    EXPECT_EQ(result.status, 2);
    return result.err;
  };
  EXPECT_EQ(said({"--plot", "a.png"}), "isorun: --plot writes a file whose name ends in .svg or .html, unlike a.png\n");
  EXPECT_EQ(said({"--plot", ".html"}), "isorun: --plot writes a file whose name ends in .svg or .html, unlike .html\n");
  EXPECT_THAT(said({"--samples", "x", "--dt", "0"}), StartsWith("isorun: --dt wants a plain number of seconds"));
  EXPECT_EQ(said({"--trace", "-", "--samples", "-"}), "isorun: --trace - and --samples - both want standard output\n");
  EXPECT_EQ(said({"--plot", "/no/such/folder/x.svg"}),
            "isorun: /no/such/folder/x.svg: cannot write: No such file or directory\n");
}

TEST(IsorunSummary, SpeaksItalian) {
  const CommandSetup clean{.input = std::string(kCleanProgram)};
  EXPECT_THAT(run_command({"isorun", "--lang", "it", "-"}, clean).out,
              StartsWith("esito: eseguito fino a M02, riga 3\n"));
  const CommandSetup italian{.input = std::string(kCleanProgram), .environment = {{"LANG", "it_IT.UTF-8"}}};
  EXPECT_THAT(run_command({"isorun", "-"}, italian).out, StartsWith("esito: "));
}

TEST(IsorunSummary, ThatCannotBeWrittenIsAFailure) {
  for (const StandardOutput output : {StandardOutput::FullDisk, StandardOutput::ClosedPipe}) {
    const CommandResult result =
        run_command({"isorun", "-"}, {.input = std::string(kCleanProgram), .standard_output = output});
    EXPECT_EQ(result.status, 2);
    EXPECT_THAT(result.err, StartsWith("isorun: "));
  }
}

TEST(IsorunError, StopsTheProgramAsTheControlWould) {
  const CommandResult result =
      run_command({"isorun", "--trace", "-", "-"}, {.input = "M06 T101001\nG00 X10\nG01\nG00 X20\nM02\n"});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(kinds_in(events_in(result.out)), ElementsAre("tool", "rapid"));
  EXPECT_EQ(result.err, "<stdin>:3: error: no coordinate comes with G01 [ISO026]\n");
}

TEST(IsorunError, IsReportedBesideTheSummary) {
  const CommandResult result = run_command({"isorun", "-"}, {.input = std::string(kBrokenProgram)});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.out, StartsWith("result: stopped by an error, line 3\n"));
  EXPECT_THAT(result.err, HasSubstr("[ISO026]"));
}

TEST(IsorunError, OfABlockLeavesNothingOfItDone) {
  const std::vector<json> events = trace_of("M06 T101001\nS100 G00 X10 X20\nM02\n");
  EXPECT_THAT(kinds_in(events), ElementsAre("tool"));
}

TEST(IsorunError, LetsNoControlCharacterThrough) {
  const CommandResult result = run_command({"isorun", "-"}, {.input = "M06 T101001\n\x1b]0;title\x07\nM02\n"});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.err.find('\x1b'), std::string::npos);
}

constexpr std::string_view kForkedProgram =
    "M06 T101001\n"
    "G00 X0\n"
    "IF VGPL >= 1 GOTO N10\n"
    "G00 X1\n"
    "N10 G00 X2\n"
    "IF V3 = 1.5 GOTO N20\n"
    "G00 X3\n"
    "N20 G00 X4\n"
    "M02\n";

std::vector<double> x_positions(const std::vector<json>& events) {
  std::vector<double> positions;
  for (const json& event : events)
    if (event.at("kind") == "rapid") positions.push_back(event.at("to")[0]);
  return positions;
}

TEST(IsorunPath, FollowsVgplAndTheRegisters) {
  EXPECT_THAT(x_positions(trace_of(kForkedProgram)), ElementsAre(0, 1, 2, 3, 4));
  EXPECT_THAT(x_positions(trace_of(kForkedProgram, {"--vgpl", "1"})), ElementsAre(0, 2, 3, 4));
  EXPECT_THAT(x_positions(trace_of(kForkedProgram, {"--vgpl", "-2.5"})), ElementsAre(0, 1, 2, 3, 4));
  EXPECT_THAT(x_positions(trace_of(kForkedProgram, {"--set", "V3=1.5"})), ElementsAre(0, 1, 2, 4));
  EXPECT_THAT(x_positions(trace_of(kForkedProgram, {"--set", "V3=1.5", "--set", "V4=2", "--vgpl", "1"})),
              ElementsAre(0, 2, 4));
}

TEST(IsorunPath, ReportsJumpsTakenAndNot) {
  const std::vector<json> events = trace_of(kForkedProgram, {"--vgpl", "1"});
  std::vector<json> jumps;
  for (const json& event : events)
    if (event.at("kind") == "jump") jumps.push_back(timeless(event));
  EXPECT_THAT(jumps, ElementsAre(json::parse(R"({"line": 3, "kind": "jump", "taken": true, "target": 5})"),
                                 json::parse(R"({"line": 6, "kind": "jump", "taken": false, "target": 7})")));
}

TEST(IsorunUntil, StopsBeforeTheLine) {
  const CommandResult result = run_command({"isorun", "--until", "2", "-"}, {.input = std::string(kBrokenProgram)});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.out, StartsWith("result: stopped where asked, line 2\n"));
  EXPECT_THAT(kinds_in(trace_of(kCleanProgram, {"--until", "2"})), ElementsAre("tool"));
  EXPECT_THAT(kinds_in(trace_of(kCleanProgram, {"--until", "100"})), ElementsAre("tool", "rapid", "end"));
}

TEST(IsorunUntil, AfterAJumpOverTheLineStopsAtItsTarget) {
  const CommandSetup forked{.input = std::string(kForkedProgram)};
  const CommandResult result = run_command({"isorun", "--vgpl", "1", "--until", "4", "-"}, forked);
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.out, StartsWith("result: stopped where asked, line 5 (the IF of line 3 jumps over the line asked "
                                     "for)\n"));
  EXPECT_THAT(run_command({"isorun", "--lang", "it", "--vgpl", "1", "--until", "4", "-"}, forked).out,
              StartsWith("esito: fermato dove richiesto, riga 5 (l'IF della riga 3 scavalca la riga richiesta)\n"));
  EXPECT_THAT(kinds_in(trace_of(kForkedProgram, {"--vgpl", "1", "--until", "4"})),
              ElementsAre("tool", "rapid", "jump"));
  EXPECT_EQ(summary_of(std::string(kForkedProgram), {"--vgpl", "1", "--until", "4"}).at("jumpedOverFrom"), 3);
  EXPECT_EQ(summary_of(std::string(kForkedProgram), {"--vgpl", "1", "--until", "5"}).at("jumpedOverFrom"), nullptr)
      << "where it leads is not passed over";
  EXPECT_EQ(summary_of(std::string(kForkedProgram), {"--until", "4"}).at("line"), 4);
}

/// A jump to nowhere is no way around the line.
TEST(IsorunUntil, AfterAJumpToNowhereIsAnError) {
  const CommandResult result =
      run_command({"isorun", "--until", "3", "-"}, {.input = "M06 T101001\nIF VGPL = 0 GOTO N5\nG00 X1\nM02\n"});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("[E004]"));
}

TEST(IsorunUsage, RefusesWhatItDoesNotKnow) {
  std::vector<std::vector<std::string>> mistakes = {{"isorun"},
                                                    {"isorun", "--no-such-option", "-"},
                                                    {"isorun", "--vgpl", "x", "-"},
                                                    {"isorun", "--until", "0", "-"},
                                                    {"isorun", "--until", "-1", "-"},
                                                    {"isorun", "--until", "1.5", "-"},
                                                    {"isorun", "--until", "99999999999999999999", "-"},
                                                    {"isorun", "--lang", "de", "-"}};
  for (const std::string number : {"", " ", "x", "1x", "nan", "inf", "-inf", "0x10", "1e3", "1,5", "--1", "1-", "1.2.3",
                                   ".", "+", " 1", "1 ", "1(a)2"}) {
    mistakes.push_back({"isorun", "--set", "V3=" + number, "-"});
    mistakes.push_back({"isorun", "--vgpl=" + number, "-"});
  }
  for (const std::string setting :
       {"V0=1", "V31=1", "V-1=1", "V+1=1", "V=1", "V3", "3=1", "v3=1", "V3 = 1", " V3=1", "V1.5=2", "V3=1=2", "="})
    mistakes.push_back({"isorun", "--set", setting, "-"});
  for (const auto& mistake : mistakes) {
    const CommandResult result = run_command(mistake, {.input = std::string(kCleanProgram)});
    EXPECT_EQ(result.status, 2) << testing::PrintToString(mistake);
    EXPECT_EQ(result.out, "") << testing::PrintToString(mistake);
    EXPECT_THAT(result.err, StartsWith("isorun: ")) << testing::PrintToString(mistake);
  }
}

TEST(IsorunUsage, NamesItsVersionAndOptions) {
  EXPECT_THAT(run_command({"isorun", "--version"}).out, MatchesRegex("isorun [0-9]+\\.[0-9]+\\.[0-9]+\n"));
  const CommandResult help = run_command({"isorun", "--help"});
  EXPECT_EQ(help.status, 0);
  for (const std::string option : {"--trace", "--vgpl", "--set", "--until", "--lang"})
    EXPECT_THAT(help.out, HasSubstr(option));
}

TEST(IsorunUsage, TakesNumbersAsProgramsWriteThem) {
  for (const std::string number : {"1.5", "+1.5", "01.50", "1.500000000000000000000000"})
    EXPECT_THAT(x_positions(trace_of(kForkedProgram, {"--set", "V3=" + number})), ElementsAre(0, 1, 2, 4)) << number;
  for (const std::string number : {"-2.5", "-.5", "0", "-0", ".5"})
    EXPECT_THAT(x_positions(trace_of(kForkedProgram, {"--vgpl", number})), ElementsAre(0, 1, 2, 3, 4)) << number;
}

TEST(IsorunUsage, TakesOneSettingAtATime) {
  const TemporaryFolder folder;
  const std::string file = folder.write("part.iso", kCleanProgram);
  EXPECT_EQ(run_command({"isorun", "--set", "V1=1", file, "--until", "2"}).status, 0);
  EXPECT_EQ(run_command({"isorun", "--set", "V1=1", "--set", "V30=-2.5", file}).status, 0);
}

TEST(IsorunUsage, ComplainsInTheReadersLanguage) {
  const auto complaint = [](std::vector<std::string> options) {
    options.insert(options.begin(), "isorun");
    return run_command(options, {.input = std::string(kCleanProgram)}).err;
  };
  EXPECT_EQ(complaint({"--set", "V31=1", "-"}),
            "isorun: --set wants a register and a plain number, V1=0 to V30=-2.5, not V31=1\n");
  EXPECT_EQ(complaint({"--lang", "it", "--set", "V31=1", "-"}),
            "isorun: --set vuole un registro e un numero semplice, da V1=0 a V30=-2.5, non V31=1\n");
  EXPECT_EQ(complaint({"--vgpl", "nan", "-"}), "isorun: --vgpl wants a plain number, such as -2.5, not nan\n");
  EXPECT_EQ(complaint({"--vgpl", "nan", "--lang", "it", "-"}),
            "isorun: --vgpl vuole un numero semplice, come -2.5, non nan\n");
  EXPECT_EQ(complaint({"--until", "0", "-"}), "isorun: --until wants a line, from 1, not 0\n");
  EXPECT_EQ(complaint({"--until", "0", "--lang", "it", "-"}), "isorun: --until vuole una riga, da 1, non 0\n");
}

TEST(IsorunUsage, LetsNoControlCharacterThrough) {
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"isorun", "--set", "\x1b[31m", "-"}, {"isorun", "\x1b[31m.iso"}}) {
    const CommandResult result = run_command(command, {.input = std::string(kCleanProgram)});
    EXPECT_EQ(result.status, 2);
    EXPECT_THAT(result.err, HasSubstr("\xEF\xBF\xBD[31m"));
    EXPECT_EQ(result.err.find('\x1b'), std::string::npos);
  }
}

TEST(IsorunOutput, ThatCannotBeWrittenIsAFailure) {
  const std::vector<std::vector<std::string>> commands = {
      {"isorun", "-"}, {"isorun", "--trace", "-", "-"}, {"isorun", "--version"}, {"isorun", "--help"}};
  for (const auto& command : commands) {
    for (const auto& [output, reason] : {std::pair{StandardOutput::FullDisk, "No space left on device"},
                                         std::pair{StandardOutput::ClosedPipe, "Broken pipe"}}) {
      const CommandResult result =
          run_command(command, {.input = std::string(kCleanProgram), .standard_output = output});
      EXPECT_EQ(result.status, 2) << testing::PrintToString(command);
      EXPECT_EQ(result.err, std::string("isorun: <stdout>: cannot write: ") + reason + "\n");
    }
  }
}

TEST(IsorunOutput, ThatCannotBeWrittenDoesNotHideTheErrorOfTheProgram) {
  const CommandResult result =
      run_command({"isorun", "-"}, {.input = std::string(kBrokenProgram), .standard_output = StandardOutput::FullDisk});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("<stdin>:3: error: no coordinate comes with G01 [ISO026]\n"));
}

TEST(IsorunInput, ThatCannotBeReadIsAFailure) {
  const TemporaryFolder folder;
  const std::string gone = folder.path("gone.iso");
  const std::string binary = folder.write("noise.iso", std::string(2000, '\x01'));
  const auto complaint = [](std::vector<std::string> command) {
    command.insert(command.begin(), "isorun");
    const CommandResult result = run_command(command);
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(result.out, "");
    return result.err;
  };
  EXPECT_EQ(complaint({gone}), "isorun: " + gone + ": cannot read: No such file or directory\n");
  EXPECT_EQ(complaint({"--lang", "it", gone}),
            "isorun: " + gone + ": non si può leggere: file o directory non esistente\n");
  EXPECT_EQ(complaint({folder.path()}), "isorun: " + folder.path() + ": is a directory\n");
  EXPECT_EQ(complaint({"--lang", "it", folder.path()}), "isorun: " + folder.path() + ": è una directory\n");
  EXPECT_EQ(complaint({binary}), "isorun: " + binary + ": looks like a binary file\n");
}

TEST(IsorunInput, IsNotOverwrittenByItsTrace) {
  const TemporaryFolder folder;
  const std::string file = folder.write("part.iso", kCleanProgram);
  const CommandResult result = run_command({"isorun", "--trace", "./part.iso", file}, {.folder = folder.path()});
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.err, "isorun: ./part.iso: this would overwrite the program\n");
  EXPECT_EQ(run_command({"isorun", file}).status, 0);
}

/// Whatever is read stays as it is, and each output has a file of its own; links and other names make no difference.
TEST(IsorunOutput, GoesToFilesOfItsOwn) {
  const TemporaryFolder folder;
  const std::string program = folder.write("part.iso", kCleanProgram);
  const std::string configuration = folder.write("isocnc.json", "{}");
  const std::string machine = folder.write("machine.json", "{}");
  const std::string taken = folder.write("old.jsonl", "old\n");
  std::filesystem::create_directory(folder.path("sub"));
  std::filesystem::create_symlink("old.jsonl", folder.path("link"));
  std::filesystem::create_hard_link(taken, folder.path("hard"));
  std::filesystem::create_symlink("nothing.svg", folder.path("dangling"));
  std::filesystem::create_symlink("isocnc.json", folder.path("config.svg"));
  const auto said = [&](std::vector<std::string> options) {
    options.insert(options.begin(), "isorun");
    options.push_back("part.iso");
    const CommandResult result = run_command(options, {.folder = folder.path()});
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(result.status, 2);
    return result.err;
  };
  EXPECT_EQ(said({"--trace", "new", "--samples", "new"}),
            "isorun: new: --trace and --samples would both be written there\n");
  EXPECT_EQ(said({"--trace", "new", "--samples", "sub/../new"}),
            "isorun: new: --trace and --samples would both be written there\n");
  EXPECT_EQ(said({"--trace", "old.jsonl", "--samples", "link"}),
            "isorun: old.jsonl: --trace and --samples would both be written there\n");
  EXPECT_EQ(said({"--samples", folder.path("hard"), "--trace", "old.jsonl", "--lang", "it"}),
            "isorun: old.jsonl: ci scriverebbero sia --trace sia --samples\n");
  EXPECT_EQ(said({"--trace", "dangling", "--plot", "nothing.svg"}),
            "isorun: dangling: --trace and --plot would both be written there\n");
  EXPECT_EQ(said({"--plot", "config.svg"}), "isorun: config.svg: this would overwrite the configuration\n");
  EXPECT_EQ(said({"--samples", "isocnc.json", "--lang", "it"}),
            "isorun: isocnc.json: così si sovrascriverebbe la configurazione\n");
  EXPECT_EQ(said({"--machine", "machine.json", "--samples", machine}),
            "isorun: " + machine + ": this would overwrite the machine's file\n");
  EXPECT_EQ(said({"--machine", "machine.json", "--restart-at", "2", "-o", "machine.json"}),
            "isorun: machine.json: this would overwrite the machine's file\n");
  EXPECT_EQ(run_command({"isorun", "--trace", "/dev/null", "--samples", "/dev/null", program}).status, 0);
  for (const auto& [file, content] : std::map<std::string, std::string>{
           {program, std::string(kCleanProgram)}, {configuration, "{}"}, {machine, "{}"}, {taken, "old\n"}}) {
    std::stringstream now;
    now << std::ifstream(file).rdbuf();
    EXPECT_EQ(now.str(), content) << file;
  }
  EXPECT_FALSE(std::filesystem::exists(folder.path("new")));
}

TEST(IsorunInput, MayBeginWithAByteOrderMark) {
  EXPECT_EQ(run_command({"isorun", "-"}, {.input = "\xEF\xBB\xBF" + std::string(kCleanProgram)}).status, 0);
}

TEST(IsorunInput, InUtf16IsRefused) {
  const TemporaryFolder folder;
  std::string wide = "\xFF\xFE";
  for (const char c : kCleanProgram) wide += std::string{c, '\0'};
  const CommandResult result = run_command({"isorun", folder.write("wide.iso", wide)});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("wide.iso: is UTF-16; save it as UTF-8 or ASCII\n"));
  EXPECT_EQ(run_command({"isorun", "--lang", "it", "-"}, {.input = wide}).err,
            "isorun: <stdin>: è in UTF-16: va salvato in UTF-8 o ASCII\n");
}

TEST(IsorunInput, WithoutM02StopsAtItsEnd) {
  const CommandResult result = run_command({"isorun", "-"}, {.input = "M06 T101001\nG00 X1\n"});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err, HasSubstr("[ISO045]"));
}

}  // namespace
}  // namespace isocnc::commands
