#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
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

TEST(IsorunTrace, TellsWhatHappensInItsOrder) {
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

TEST(IsorunTrace, ThatCannotBeWrittenIsTrouble) {
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
            "cycle time: 46.3 s (cutting 19.8 s, rapids 2.4 s, waiting 24.0 s)\n"
            "blocks: 63\n"
            "rapids: 8 (1083.213 mm)\n"
            "feed moves: 32, arcs: 14 (1698.201 mm)\n"
            "extents (machine): X 0.000..554.000, Y 0.000..354.000, Z -197.500..0.000, B 0.000..0.000, "
            "C 0.000..0.000\n"
            "tool T101001: 27.9 s, feed moves 1316.237 mm, rapids 800.725 mm\n"
            "tool T102003: 18.3 s, feed moves 381.965 mm, rapids 282.488 mm\n"
            "final position (machine): X350.000 Y220.000 Z-155.500 B0.000 C0.000\n");
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

TEST(IsorunPlot, IsAPictureOfWhatWasDone) {
  const TemporaryFolder folder;
  const std::string program = folder.write("a<b>&.iso", "M06 T101001\nG00 X50\nG03 X50 Y40 R20 F1000\nM02\n");
  const std::string plot = folder.path("part.svg");
  EXPECT_EQ(run_command({"isorun", "--plot", plot, program}).status, 0);
  std::stringstream svg;
  svg << std::ifstream(plot).rdbuf();
  EXPECT_THAT(svg.str(), StartsWith("<svg "));
  EXPECT_THAT(svg.str(), HasSubstr("a&lt;b&gt;&amp;.iso</title>"));
  EXPECT_THAT(svg.str(), HasSubstr("d=\"M0.000 -0.000L50.000 -0.000\""));
  EXPECT_THAT(svg.str(), HasSubstr("T101001"));
}

TEST(IsorunOptions, RefuseWhatMakesNoSense) {
  const auto said = [](std::vector<std::string> options) {
    options.insert(options.begin(), "isorun");
    options.push_back("-");
    const CommandResult result = run_command(options, {.input = std::string(kCleanProgram)});
    EXPECT_EQ(result.status, 2);
    return result.err;
  };
  EXPECT_EQ(said({"--plot", "a.png"}), "isorun: --plot writes SVG, so the name has to end in .svg, unlike a.png\n");
  EXPECT_THAT(said({"--samples", "x", "--dt", "0"}), StartsWith("isorun: --dt wants a plain number of seconds"));
  EXPECT_EQ(said({"--trace", "-", "--samples", "-"}), "isorun: --trace - and --samples - both want standard output\n");
  EXPECT_EQ(said({"--plot", "/no/such/folder/x.svg"}),
            "isorun: /no/such/folder/x.svg: cannot write: No such file or directory\n");
}

TEST(IsorunSummary, SpeaksItalian) {
  const Surroundings clean{.input = std::string(kCleanProgram)};
  EXPECT_THAT(run_command({"isorun", "--lang", "it", "-"}, clean).out,
              StartsWith("esito: eseguito fino a M02, riga 3\n"));
  const Surroundings italian{.input = std::string(kCleanProgram), .environment = {{"LANG", "it_IT.UTF-8"}}};
  EXPECT_THAT(run_command({"isorun", "-"}, italian).out, StartsWith("esito: "));
}

TEST(IsorunSummary, ThatCannotBeWrittenIsTrouble) {
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

TEST(IsorunError, IsToldBesideTheSummary) {
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

TEST(IsorunPath, TellsOfJumpsTakenAndNot) {
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

TEST(IsorunOutput, ThatCannotBeWrittenIsTrouble) {
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

TEST(IsorunInput, ThatCannotBeReadIsTrouble) {
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
