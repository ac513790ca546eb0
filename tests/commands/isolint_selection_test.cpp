#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "programs.h"
#include "run_command.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text_of_file.h"

namespace isocnc::commands {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

/// Two errors, ISO003 and ISO026, a warning W001 and again ISO003.
constexpr std::string_view kMixedProgram =
    "M06 T101001\n"
    "G00 X10 U5\n"
    "G71\n"
    "G71\n"
    "G01\n"
    "G00 X20 W5\n"
    "M02\n";

struct Seen {
  std::vector<std::string> codes;
  int status = 0;
};

/// What is found in kMixedProgram with these options.
Seen with(std::vector<std::string> options) {
  options.insert(options.begin(), {"isolint", "--format", "json"});
  options.push_back("-");
  const CommandResult result = run_command(options, {.input = std::string(kMixedProgram)});
  EXPECT_EQ(result.err, "");
  Seen seen{.status = result.status};
  for (const json& finding : json::parse(result.out)) seen.codes.push_back(finding["code"]);
  return seen;
}

TEST(IsolintSelection, ShowsWhatIsSelected) {
  EXPECT_THAT(with({}).codes, ElementsAre("ISO003", "W001", "ISO026", "ISO003"));
  EXPECT_THAT(with({"--select", "ISO026"}).codes, ElementsAre("ISO026"));
  EXPECT_THAT(with({"--select", "iso026,W001"}).codes, ElementsAre("W001", "ISO026"));
  EXPECT_THAT(with({"--select", "ISO026", "--select", "w"}).codes, ElementsAre("W001", "ISO026"));
  EXPECT_THAT(with({"--select=missing-coordinate"}).codes, ElementsAre("ISO026"));
  EXPECT_THAT(with({"--select", "all"}).codes, ElementsAre("ISO003", "W001", "ISO026", "ISO003"));
  EXPECT_THAT(with({"--select", "E"}).codes, IsEmpty());
}

TEST(IsolintSelection, ShowsNotWhatIsIgnored) {
  EXPECT_THAT(with({"--ignore", "ISO003"}).codes, ElementsAre("W001", "ISO026"));
  EXPECT_THAT(with({"--ignore", "ISO"}).codes, ElementsAre("W001"));
  EXPECT_THAT(with({"--ignore", "ALL"}).codes, IsEmpty());
}

TEST(IsolintSelection, LetsTheMoreExactDecide) {
  EXPECT_THAT(with({"--select", "ISO", "--ignore", "ISO003"}).codes, ElementsAre("ISO026"));
  EXPECT_THAT(with({"--ignore", "ISO", "--select", "ISO003"}).codes, ElementsAre("ISO003", "ISO003"));
  EXPECT_THAT(with({"--select", "ISO003", "--ignore", "ISO003"}).codes, IsEmpty());
  EXPECT_THAT(with({"--severity", "ALL=off", "--severity", "W=info"}).codes, ElementsAre("W001"));
  EXPECT_THAT(with({"--severity", "W001=error,W=off"}).codes, ElementsAre("ISO003", "W001", "ISO026", "ISO003"));
  // A weight alone selects nothing.
  EXPECT_THAT(with({"--select", "W", "--severity", "ISO=warning"}).codes, ElementsAre("W001"));
  EXPECT_THAT(with({"--ignore", "ISO", "--severity", "ISO026=warning"}).codes, ElementsAre("W001"));
}

TEST(IsolintSelection, CountsByTheSeverityGiven) {
  EXPECT_EQ(with({"--ignore", "ISO"}).status, 0);
  EXPECT_EQ(with({"--severity", "ISO=warning"}).status, 0);
  EXPECT_EQ(with({"--select", "W001", "--severity", "W001=error"}).status, 1);
  EXPECT_EQ(with({"--exit-zero"}).status, 0);
  const CommandResult result = run_command({"isolint", "--severity", "W001=error,ISO026=off,ISO003=Info", "-"},
                                           {.input = std::string(kMixedProgram)});
  EXPECT_THAT(result.out, StartsWith("info[ISO003]"));
  EXPECT_THAT(result.out, HasSubstr("\nerror[W001]"));
  EXPECT_EQ(result.err, "1 error, 0 warnings, 2 notes in 1 file\n");
}

TEST(IsolintSelection, RefusesCodesThatItDoesNotKnow) {
  const auto said = [](const std::string& option, const std::string& value) {
    const CommandResult result = run_command({"isolint", option, value, "-"});
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(result.out, "");
    return result.err;
  };
  EXPECT_EQ(said("--select", " ,"), "isolint: select names no code; ALL names them all\n");
  EXPECT_EQ(said("--select", "ISO31,W001"), "isolint: unknown code: ISO31; did you mean ISO031? (--list-rules)\n");
  EXPECT_EQ(said("--ignore", "arc-centre-mismatch"),
            "isolint: unknown code: arc-centre-mismatch; did you mean arc-center-mismatch? (--list-rules)\n");
  EXPECT_EQ(said("--severity", "X1=off"), "isolint: unknown code: X1 (--list-rules)\n");
  EXPECT_EQ(said("--severity", "W001=loud"), "isolint: W001=loud: write CODE=error, warning, info or off\n");
  EXPECT_EQ(said("--severity", "W001"), "isolint: W001: write CODE=error, warning, info or off\n");
}

TEST(IsolintSelection, LeavesThePathAfterAListAlone) {
  const support::TemporaryFolder folder;
  folder.write("part.iso", kMixedProgram);
  const CommandResult result =
      run_command({"isolint", "--format", "concise", "--select", "W001", "part.iso"}, {.folder = folder.path()});
  EXPECT_EQ(result.out, "part.iso:4:1: warning: G71 is already in force [W001]\n");
}

TEST(IsolintMaxWarnings, FailsOnMore) {
  const CommandSetup warned{.input = std::string(kWarnedProgram)};
  EXPECT_EQ(run_command({"isolint", "--max-warnings", "1", "-"}, warned).status, 0);
  const CommandResult result = run_command({"isolint", "--max-warnings", "0", "-"}, warned);
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.err, "0 errors, 1 warning in 1 file\nisolint: too many warnings: 1, and 0 allowed\n");
  EXPECT_EQ(run_command({"isolint", "--max-warnings", "0", "--exit-zero", "-"}, warned).status, 0);
  EXPECT_EQ(run_command({"isolint", "--max-warnings", "-1", "-"}, warned).status, 2);
}

TEST(IsolintExitZero, DoesNotHideAFailure) {
  EXPECT_EQ(run_command({"isolint", "--exit-zero", "no-such-file.iso"}).status, 2);
}

TEST(IsolintOutputFile, HoldsWhatElseWouldBePrinted) {
  const support::TemporaryFolder folder;
  const CommandSetup mixed{.input = std::string(kMixedProgram), .folder = folder.path()};
  const std::string expected = run_command({"isolint", "-"}, mixed).out;
  const CommandResult result = run_command({"isolint", "--output", "findings.txt", "-"}, mixed);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err, "3 errors, 1 warning in 1 file\n");
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(text_of_file(folder.path("findings.txt")), expected);
}

TEST(IsolintOutputFile, SaysWhyItCannotBeWritten) {
  const CommandSetup mixed{.input = std::string(kMixedProgram)};
  const CommandResult nowhere = run_command({"isolint", "--output", "/no/such/folder/x", "-"}, mixed);
  EXPECT_EQ(nowhere.status, 2);
  EXPECT_EQ(nowhere.err, "isolint: /no/such/folder/x: cannot write: No such file or directory\n");
  const CommandResult full = run_command({"isolint", "--output", "/dev/full", "-"}, mixed);
  EXPECT_EQ(full.status, 2);
  EXPECT_EQ(full.err, "isolint: /dev/full: cannot write: No space left on device\n");
}

TEST(IsolintOutputFile, IsNoneOfThePrograms) {
  const support::TemporaryFolder folder;
  const std::string program = folder.write("part.iso", kMixedProgram);
  const CommandResult result = run_command({"isolint", "--output", "./part.iso", "."}, {.folder = folder.path()});
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.err, "isolint: ./part.iso: is one of the programs to be checked\n");
  EXPECT_EQ(text_of_file(program), kMixedProgram);
}

TEST(IsolintOutputFile, IsNothingThatIsRead) {
  const support::TemporaryFolder folder;
  folder.write("part.iso", kMixedProgram);
  const std::string configuration = folder.write("isocnc.json", "{}\n");
  const std::string baseline = folder.write("known.json", "{\"version\": 1, \"findings\": []}\n");
  const auto refusal_of = [&](std::vector<std::string> options) {
    options.insert(options.begin(), "isolint");
    options.emplace_back("part.iso");
    const CommandResult result = run_command(options, {.folder = folder.path()});
    EXPECT_EQ(result.status, 2);
    return result.err;
  };
  EXPECT_EQ(refusal_of({"--output", "isocnc.json"}), "isolint: isocnc.json: is the configuration\n");
  EXPECT_EQ(refusal_of({"--write-baseline", "./isocnc.json"}), "isolint: ./isocnc.json: is the configuration\n");
  EXPECT_EQ(refusal_of({"--baseline", "known.json", "--output", "known.json"}),
            "isolint: known.json: is the baseline\n");
  EXPECT_EQ(refusal_of({"--write-baseline", "new.json", "--output", "./new.json"}),
            "isolint: ./new.json: is written by --write-baseline\n");
  EXPECT_EQ(text_of_file(configuration), "{}\n");
  EXPECT_EQ(text_of_file(baseline), "{\"version\": 1, \"findings\": []}\n");
  EXPECT_FALSE(std::filesystem::exists(folder.path("new.json")));
}

TEST(IsolintStatistics, CountsTheFindingsOfEachCode) {
  const CommandSetup mixed{.input = std::string(kMixedProgram)};
  for (const auto& [language, said] : {std::pair("en", "--statistics: only with --format text, concise, json\n"),
                                       std::pair("it", "--statistics: solo con --format text, concise, json\n")}) {
    const CommandResult refused =
        run_command({"isolint", "--lang", language, "--statistics", "--format", "sarif", "-"}, mixed);
    EXPECT_EQ(refused.status, 2);
    EXPECT_EQ(refused.out, "");
    EXPECT_EQ(refused.err, std::string("isolint: ") + said);
  }
  const CommandResult table = run_command({"isolint", "--statistics", "-"}, mixed);
  EXPECT_EQ(table.out,
            "     2  ISO003  error    Unknown word\n"
            "     1  ISO026  error    Missing coordinate\n"
            "     1  W001    warning  Repeated modal G\n");
  EXPECT_EQ(table.err, "3 errors, 1 warning in 1 file\n");
  EXPECT_EQ(table.status, 1);
  const json counts = json::parse(run_command({"isolint", "--statistics", "--format", "json", "-"}, mixed).out);
  ASSERT_EQ(counts.size(), 3u);
  EXPECT_EQ(counts[0], json::parse(R"({"code": "ISO003", "name": "unknown-word", "severity": "error",
                                       "title": "Unknown word", "count": 2})"));
}

}  // namespace
}  // namespace isocnc::commands
