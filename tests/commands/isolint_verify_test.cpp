#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <tuple>

#include <nlohmann/json.hpp>

#include "run_command.h"
#include "tests/support/example_programs.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text_of_file.h"

namespace isocnc::commands {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr std::string_view kLimitedMachine = R"({"machine": {
  "axes": {"X": {"min": 0, "max": 100}, "Z": {"min": -50, "max": 120}}, "maxFeed": 5000,
  "tools": [{"head": 1, "holder": 1, "tool": 1, "radius": 10, "length": 40}]}})";

/// X leaves its travel on three lines, the entry of the contour gouges, and F is too high.
constexpr std::string_view kOutsideProgram =
    "M06 T101001\n"
    "G00 X130\n"
    "Y20\n"
    "X140\n"
    "X30 Y20\n"
    "G41 G01 X0 Y0 F6000\n"
    "Y45\n"
    "G40\n"
    "M02\n";

class IsolintVerify : public testing::Test {
 protected:
  IsolintVerify() {
    folder_.write("isocnc.json", kLimitedMachine);
    folder_.write("part.iso", kOutsideProgram);
  }

  CommandResult run(std::vector<std::string> command) const {
    return run_command(std::move(command), {.folder = folder_.path()});
  }
  json findings(std::vector<std::string> options) const {
    options.insert(options.begin(), {"isolint", "--format", "json"});
    return json::parse(run(options).out);
  }

  const support::TemporaryFolder folder_;
};

/// `E160@2`: code and line of each finding.
std::vector<std::string> places_of(const json& findings) {
  std::vector<std::string> places;
  for (const json& finding : findings)
    places.push_back(finding.at("code").get<std::string>() + "@" + std::to_string(finding.at("line").get<int>()));
  return places;
}

TEST_F(IsolintVerify, PutsTheMachineIntoTheSameList) {
  EXPECT_THAT(places_of(findings({"part.iso"})), ElementsAre("W130@2", "W130@4", "W131@6"));
  const json all = findings({"--verify", "part.iso"});
  EXPECT_THAT(places_of(all), ElementsAre("E160@2", "E160@6", "W138@6", "W131@6"));
  const json& travel = all[0];
  EXPECT_EQ(travel.at("source"), "run");
  EXPECT_EQ(travel.at("severity"), "error");
  EXPECT_EQ(travel.at("endColumn"), 9);
  EXPECT_EQ(
      travel.at("message"),
      "the machine's X leaves its travel: it goes to 140, and the travel ends at 100 (and 2 more lines, to line 4)");
  EXPECT_EQ(travel.at("repeats"), 2);
  EXPECT_FALSE(all[3].contains("source")) << "the text shows it, too";
}

TEST_F(IsolintVerify, FailsBecauseOfTheMachine) {
  EXPECT_EQ(run({"isolint", "part.iso"}).status, 0);
  EXPECT_EQ(run({"isolint", "--verify", "part.iso"}).status, 1);
  EXPECT_EQ(run({"isolint", "--verify", "--ignore", "E160", "part.iso"}).status, 0);
  EXPECT_EQ(run({"isolint", "--verify", "--severity", "E160=warning", "part.iso"}).status, 0);
}

TEST_F(IsolintVerify, JudgesByTheTipWhereTheJointsAreNotWanted) {
  EXPECT_THAT(places_of(findings({"--verify", "--ignore", "E160,W138", "part.iso"})),
              ElementsAre("W130@2", "W130@4", "W131@6"));
}

TEST_F(IsolintVerify, TakesBaselinesAndComments) {
  ASSERT_EQ(run({"isolint", "--verify", "--write-baseline", "known.json", "part.iso"}).status, 0);
  EXPECT_EQ(findings({"--verify", "--baseline", "known.json", "part.iso"}), json::array());
  folder_.write("part.iso", "(isolint: disable E160 W138)\n" + std::string(kOutsideProgram));
  EXPECT_THAT(places_of(findings({"--verify", "part.iso"})), ElementsAre("W131@7"));
  EXPECT_THAT(places_of(findings({"part.iso"})), ElementsAre("W130@3", "W130@5", "W131@7")) << "no W190";
}

TEST_F(IsolintVerify, AsksTheMachineAboutTheFixedProgram) {
  folder_.write("part.iso", "M06 T101001\nG71\nG71\nG00 X130\nM02\n");
  const CommandResult result = run({"isolint", "--verify", "--fix", "--format", "concise", "part.iso"});
  EXPECT_THAT(result.out, HasSubstr("error: the machine's X")) << result.err;
  EXPECT_THAT(result.err, HasSubstr("1 fixed"));
}

TEST_F(IsolintVerify, SaysHowFarTheRunWent) {
  folder_.write("part.iso", "M06 T101001\nG01 X50\nG00 X130\nM02\n");
  EXPECT_THAT(places_of(findings({"--verify", "part.iso"})), ElementsAre("ISO066@2", "W162@2", "W130@3"));
}

/// All formats have the findings of the machine; SARIF names their source.
TEST_F(IsolintVerify, IsInAllFormats) {
  for (const char* const format : {"text", "concise", "json", "sarif", "github", "gitlab", "junit", "checkstyle"})
    EXPECT_THAT(run({"isolint", "--verify", "--format", format, "part.iso"}).out, HasSubstr("E160")) << format;
  const json log = json::parse(run({"isolint", "--verify", "--format", "sarif", "part.iso"}).out);
  EXPECT_EQ(log["runs"][0]["results"][0]["properties"],
            json::parse(R"({"repeats": 2, "lastLine": 4, "source": "run"})"));
}

TEST_F(IsolintVerify, SaysTheSameWithAnyNumberOfJobs) {
  for (std::size_t i = 0; i < 20; ++i)
    folder_.write("parts/" + std::to_string(i) + ".iso", std::string(i, '\n') + std::string(kOutsideProgram));
  const std::string one = run({"isolint", "--verify", "--jobs", "1", "."}).out;
  EXPECT_THAT(one, HasSubstr("parts/19.iso:21:1"));
  for (const char* const jobs : {"2", "7"}) EXPECT_EQ(run({"isolint", "--verify", "--jobs", jobs, "."}).out, one);
}

TEST_F(IsolintVerify, AgreesWithIsorunInWords) {
  const CommandResult result = run({"isorun", "--verify", "part.iso"});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.err, "");
  const std::string text = run({"isolint", "--verify", "part.iso"}).out;
  EXPECT_EQ(result.out.substr(0, result.out.find("result: ")), text);
  const json summary = json::parse(run({"isorun", "--verify", "--json", "part.iso"}).out);
  json of_text = findings({"--verify", "part.iso"});
  of_text[3]["source"] = "run";
  EXPECT_EQ(summary.at("findings"), of_text);
}

constexpr std::string_view kProgramWithJumps =
    "M06 T101001\nIF VGPL >= 1 GOTO N30\nG00 X30\nM02\nN30 G00 X130\nIF VGPL = 2 GOTO N40\nM02\nN40 Z130\nM02\n";

TEST_F(IsolintVerify, RunsEachPathThatVgplLeadsAlong) {
  folder_.write("part.iso", kProgramWithJumps);
  const json found = findings({"--verify", "part.iso"});
  EXPECT_THAT(places_of(found), ElementsAre("E160@5", "E160@8"));
  EXPECT_EQ(found[0].at("path"), json::parse(R"([{"line": 2, "text": "IF VGPL >= 1 GOTO N30: jumps"}])"));
  EXPECT_EQ(found[1].at("path"), json::parse(R"([{"line": 2, "text": "IF VGPL >= 1 GOTO N30: jumps"},
                                                 {"line": 6, "text": "IF VGPL = 2 GOTO N40: jumps"}])"));
  // With VGPL 2 X is still outside there: the same mistake.
  EXPECT_EQ(found[0].at("message"),
            "the machine's X leaves its travel: it goes to 130, and the travel ends at 100 (and 1 more line, line 8)");
  for (const char* const jobs : {"1", "2"})
    EXPECT_EQ(findings({"--verify", "--jobs", jobs, "part.iso"}), found) << "with " << jobs << " jobs";
}

TEST_F(IsolintVerify, IsorunSaysThatItHasRunOnePath) {
  folder_.write("part.iso", kProgramWithJumps);
  folder_.write("part.setup.json", R"({"fixtures": [{"name": "clamp", "box": [[900, 900, 0], [950, 950, 30]]}]})");
  const CommandResult result = run({"isorun", "--verify", "--vgpl", "1", "part.iso"});
  EXPECT_THAT(result.out,
              HasSubstr("info[W162]: where this jump leads with other values of VGPL is not verified (paths "
                        "that were run: 1)\n --> part.iso:2:1\n"));
  EXPECT_THAT(
      result.out,
      HasSubstr(
          "other values of VGPL at the jump of line 2, T101001 has no holder, the spindle nose is not described\n"));
  const json summary = json::parse(run({"isorun", "--json", "part.iso"}).out);
  EXPECT_THAT(summary.at("verification").at("certificate").at("notVerified").dump(),
              HasSubstr("other values of VGPL at the jump of line 2"));
}

TEST_F(IsolintVerify, LeavesStandardOutputToATrace) {
  const CommandResult result = run({"isorun", "--verify", "--trace", "-", "part.iso"});
  EXPECT_THAT(result.err, HasSubstr("error[E160]"));
  EXPECT_THAT(result.out, Not(HasSubstr("E160")));
}

TEST_F(IsolintVerify, PlainRunFailsAndSaysWhy) {
  const CommandResult result = run({"isorun", "part.iso"});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.err,
              AllOf(StartsWith("part.iso:2: error: the machine's X leaves its travel: it goes to 140, and the travel "
                               "ends at 100 (and 2 more lines, to line 4) [E160]\n"),
                    HasSubstr("part.iso:6: warning: here a cutter"), Not(HasSubstr("W131"))));
  EXPECT_THAT(result.out, AllOf(StartsWith("result: ran to M02"), HasSubstr("feed above the machine's: 6000 mm/min")));
  folder_.write("isocnc.json", std::string(kLimitedMachine.substr(0, kLimitedMachine.size() - 1)) +
                                   R"(, "lint": {"ignore": ["W138"], "severity": {"E160": "info", "W131": "error"}}})");
  const CommandResult other = run({"isorun", "part.iso"});
  EXPECT_EQ(other.status, 1);
  EXPECT_THAT(other.err, AllOf(HasSubstr("part.iso:2: info: "), HasSubstr("part.iso:6: error: F6000 means 6000 mm/min"),
                               Not(HasSubstr("W138"))));
  folder_.write("part.iso", "(isolint: ignore-file E160)\n" + std::string(kOutsideProgram));
  EXPECT_THAT(run({"isorun", "part.iso"}).err, Not(HasSubstr("E160")));
}

using Place = std::tuple<int, int, std::string>;

std::set<Place> places_in(const json& findings, const std::set<std::string>& left_out = {}) {
  std::set<Place> places;
  for (const json& finding : findings)
    if (!left_out.contains(finding.at("code")))
      places.emplace(finding.at("line"), finding.at("column"), finding.at("code"));
  return places;
}

/// On each of these machines, `isolint --verify` says what isolint and isorun say, less W130 where joints decide.
TEST(IsolintVerifyExamples, IsTheUnionOfTheTextAndTheRun) {
  const std::string examples = ISOCNC_SOURCE_DIR "/examples/";
  const std::vector<std::vector<std::string>> machines = {{},
                                                          {"--config", examples + "machines/head.json"},
                                                          {"--config", examples + "machines/three-axis.json"},
                                                          {"--config", examples + "compensation/isocnc.json"}};
  std::size_t of_runs = 0;
  for (const std::filesystem::path& file : support::example_programs()) {
    for (const std::vector<std::string>& machine : machines) {
      const auto findings_of = [&](std::vector<std::string> command) {
        command.insert(command.end(), machine.begin(), machine.end());
        command.push_back(file);
        return json::parse(run_command(command).out);
      };
      const json both = findings_of({"isolint", "--format", "json", "--verify"});
      const json run = findings_of({"isorun", "--json", "--verify"}).at("findings");
      std::set<Place> joined = places_in(findings_of({"isolint", "--format", "json"}), {"W130"});
      joined.merge(places_in(run));
      // Each value of VGPL leads along another path; that there are others is said of each.
      const bool has_jumps = text_of_file(file).find("IF VGPL") != std::string::npos;
      for (const char* const vgpl : {"1", "2", "3"})
        if (has_jumps)
          joined.merge(places_in(findings_of({"isorun", "--json", "--verify", "--vgpl", vgpl}).at("findings")));
      const std::set<std::string> left_out =
          has_jumps ? std::set<std::string>{"W130", "W162"} : std::set<std::string>{"W130"};
      std::erase_if(joined, [&](const Place& place) { return left_out.contains(std::get<2>(place)); });
      EXPECT_EQ(places_in(both, left_out), joined) << file << " " << json(machine);
      EXPECT_TRUE(std::is_sorted(both.begin(), both.end(), [](const json& a, const json& b) {
        return std::pair(a.at("line").get<int>(), a.at("column").get<int>()) <
               std::pair(b.at("line").get<int>(), b.at("column").get<int>());
      })) << file;
      of_runs += run.size();
    }
  }
  EXPECT_GT(of_runs, 10u);
}

TEST(IsolintVerifyExamples, FindsNothingInThoseThatAreRight) {
  for (const std::filesystem::path& file : support::example_programs()) {
    if (file.parent_path().filename() == "broken") continue;
    // In one of them the operator sets a register.
    EXPECT_EQ(run_command({"isolint", "--format", "concise", "--verify", "--ignore", "W162", file}).out,
              run_command({"isolint", "--format", "concise", file}).out);
  }
}

}  // namespace
}  // namespace isocnc::commands
