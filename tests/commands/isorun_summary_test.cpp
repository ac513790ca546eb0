#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "programs.h"
#include "run_command.h"
#include "tests/support/temporary_folder.h"

namespace isocnc::commands {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::StartsWith;

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
  EXPECT_EQ(frames[0].at("extents").at("Y"), json::parse("[-200.0, 40.0]")) << "and again after G27";
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
  const support::TemporaryFolder folder;
  const std::string machine = folder.write("head.json", R"({"machine": {
    "kinematics": {"type": "head", "pivot": 100, "bFromC": {"x": 20}, "spindleFromB": {"y": 7}},
    "tools": [{"head": 1, "holder": 1, "tool": 1, "length": 50}]}})");
  const json joints = summary_of("M06 T101001\nG00 X0 Y0 Z0 C90\nM02\n", {"--machine", machine}).at("finalJoints");
  const double expected[] = {27, -13, 50, 0, 90};
  for (std::size_t axis = 0; axis < 5; ++axis) EXPECT_NEAR(joints[axis], expected[axis], 1e-9) << axis;
}

TEST(IsorunMachine, GivesTimesAndTravel) {
  const support::TemporaryFolder folder;
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
  const support::TemporaryFolder folder;
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

TEST(IsorunMachine, SaysThatItsLengthsAreInMillimetersWhereTheProgramHasInches) {
  const auto summary = [](const std::string& unit) {
    return run_command({"isorun", "-"}, {.input = "M06 T101001\n" + unit + "G00 X1\nM02\n"}).out;
  };
  EXPECT_THAT(summary("G70\n"), HasSubstr("\nlengths and positions: in mm, also of blocks under G70\n"
                                          "final position (machine): X25.400 "));
  EXPECT_THAT(summary(""), testing::Not(HasSubstr("in mm, also")));
}

TEST(IsorunMachine, ReportsHowFarItsTravelIsLeftAndWhereFirst) {
  const support::TemporaryFolder folder;
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
  const support::TemporaryFolder folder;
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
  const support::TemporaryFolder folder;
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

}  // namespace
}  // namespace isocnc::commands
