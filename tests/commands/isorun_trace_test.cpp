#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "programs.h"
#include "run_command.h"
#include "tests/support/temporary_folder.h"

namespace isocnc::commands {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::IsSupersetOf;
using testing::StartsWith;

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
  const support::TemporaryFolder folder;
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

/// Also where the tool is longer than the program knows, and where a feed is given as a time.
TEST(IsorunTrace, HasTheLengthsOfTheSummary) {
  const std::string program =
      "M06 T101001\nG00 X10 B90\nG00 B0 Z20\nG01 X50 F4000\nG03 X90 I70 J0 Z5\nG49\nX120 B30 C40\nG93\nG01 Y50 C0 F20\n"
      "G02 X150 R40 B0 F30\nG94\nM06 T101002\nG00 X0\nM02\n";
  const support::TemporaryFolder folder;
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
  const support::TemporaryFolder folder;
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

}  // namespace
}  // namespace isocnc::commands
