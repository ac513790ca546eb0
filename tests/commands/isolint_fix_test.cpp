#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include <nlohmann/json.hpp>

#include "programs.h"
#include "run_command.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text_of_file.h"

namespace isocnc::commands {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

/// A safe fix (W001), an unsafe one (ISO006), and a finding without a fix (ISO003).
constexpr std::string_view kMendable =
    "M06 T101001\n"
    "G71\n"
    "G71 G00 X10,5 ; gi\xC3\xB9\n"
    "G00 Y5 U5\n"
    "M02\n";
constexpr std::string_view kSafelyMended =
    "M06 T101001\n"
    "G71\n"
    "G00 X10,5 ; gi\xC3\xB9\n"
    "G00 Y5 U5\n"
    "M02\n";
constexpr std::string_view kMended =
    "M06 T101001\n"
    "G71\n"
    "G00 X10.5 ; gi\xC3\xB9\n"
    "G00 Y5 U5\n"
    "M02\n";

CommandResult run_on(const std::string& input, std::vector<std::string> options) {
  options.insert(options.begin(), "isolint");
  options.emplace_back("-");
  return run_command(options, {.input = input});
}

TEST(IsolintFix, MendsWhatIsSafe) {
  const support::TemporaryFolder folder;
  const std::string file = folder.write("part.iso", kMendable);
  const CommandResult result =
      run_command({"isolint", "--fix", "--format", "concise", "part.iso"}, {.folder = folder.path()});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(text_of_file(file), kSafelyMended);
  EXPECT_THAT(result.out, AllOf(HasSubstr("part.iso:3:6: error: "), HasSubstr("[ISO006]"), HasSubstr("[ISO003]"),
                                Not(HasSubstr("W001"))));
  EXPECT_EQ(result.err, "1 fixed\n");
}

TEST(IsolintFix, MendsWhatIsLikelyWhenAskedTo) {
  const support::TemporaryFolder folder;
  const std::string file = folder.write("part.iso", kMendable);
  const CommandResult result = run_command({"isolint", "--fix", "--unsafe-fixes", file});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(text_of_file(file), kMended);
  EXPECT_EQ(result.err, "1 error, 0 warnings in 1 file; 2 fixed\n");
  // A second time there is nothing left to do.
  const CommandResult again = run_command({"isolint", "--fix", "--unsafe-fixes", "--lang", "it", file});
  EXPECT_EQ(text_of_file(file), kMended);
  EXPECT_THAT(again.err, EndsWith("; 0 corretti\n"));
}

TEST(IsolintFix, MentionsUnsafeFixesButMakesNone) {
  const support::TemporaryFolder folder;
  const std::string file = folder.write("part.iso", kMendable);
  EXPECT_THAT(run_command({"isolint", file}).out,
              AllOf(HasSubstr("= help: remove G71, already in force (--fix): G00 X10,5 ; gi\xC3\xB9\n"),
                    HasSubstr("= help: write 10.5 (--fix --unsafe-fixes): G71 G00 X10.5 ; gi\xC3\xB9\n")));
  EXPECT_THAT(run_command({"isolint", "--unsafe-fixes", "--lang", "it", file}).out,
              HasSubstr("= aiuto: scrivere 10.5 (--fix): "));
  EXPECT_EQ(text_of_file(file), kMendable);
}

TEST(IsolintFix, DoesNotFixWhatIsNotSelected) {
  const std::string silenced = "M06 T101001\nG71\nG71 ;isolint: ignore W001\nM02\n";
  EXPECT_EQ(run_on(silenced, {"--fix"}).out, silenced);
  EXPECT_EQ(run_on(std::string(kMendable), {"--fix", "--ignore", "W001"}).out, kMendable);
  EXPECT_EQ(run_on(std::string(kMendable), {"--fix", "--select", "ISO"}).out, kMendable);
  EXPECT_EQ(run_on(std::string(kMendable), {"--fix", "--severity", "W001=off"}).out, kMendable);
  const support::TemporaryFolder folder;
  const std::string file = folder.write("part.iso", kMendable);
  const std::string baseline = folder.path("known.json");
  EXPECT_EQ(run_command({"isolint", "--write-baseline", baseline, file}).status, 0);
  const CommandResult result = run_command({"isolint", "--fix", "--unsafe-fixes", "--baseline", baseline, file});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(text_of_file(file), kMendable);
  EXPECT_EQ(result.err, "0 errors, 0 warnings in 1 file; 3 in the baseline; 0 fixed\n");
}

/// A fix that brings a finding is no fix, even where that one is not selected: M02 here, with the spindle in doubt.
TEST(IsolintFix, AddsNothingThatIsNotSelected) {
  const std::string program = "M06 T101001\nG00 X10 M02 G00 X20\n";
  EXPECT_EQ(run_on(program, {"--fix", "--unsafe-fixes", "--select", "ISO043"}).out, program);
}

/// One G49 mends all lines that lack it; an F without a feed move is removed from each line.
TEST(IsolintFix, MendsRepeatedMistakes) {
  const CommandResult once =
      run_on("M06 T101001\nG01 X1 B1 F500\nX2 B2\nC3\nX4\nX5 B5\nM02\n", {"--fix", "--unsafe-fixes"});
  EXPECT_EQ(once.out, "M06 T101001\nG49\nG01 X1 B1 F500\nX2 B2\nC3\nX4\nX5 B5\nM02\n");
  EXPECT_THAT(once.err, HasSubstr("1 fixed"));
  const CommandResult each = run_on("M06 T101001\nG93\nF4\nG00 X0 F5\nM08\nF6\nG01 X1 F7\nM02\n", {"--fix"});
  EXPECT_EQ(each.out, "M06 T101001\nG93\nG00 X0\nM08\nG01 X1 F7\nM02\n");
  EXPECT_THAT(each.err, HasSubstr("1 fixed"));
}

TEST(IsolintFix, PrintsTheProgramOfStandardInput) {
  const CommandResult result = run_on(std::string(kMendable), {"--fix", "--format", "concise"});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.out, kSafelyMended);
  EXPECT_THAT(result.err, AllOf(HasSubstr("<stdin>:3:6: error: "), HasSubstr("1 fixed\n")));
  const CommandResult clean = run_on(std::string(kCleanProgram), {"--fix"});
  EXPECT_EQ(clean.status, 0);
  EXPECT_EQ(clean.out, kCleanProgram);
  const support::TemporaryFolder folder;
  const CommandResult apart =
      run_on(std::string(kMendable), {"--fix", "--format", "json", "--output", folder.path("found.json")});
  EXPECT_EQ(apart.out, kSafelyMended);
  EXPECT_EQ(json::parse(text_of_file(folder.path("found.json"))).size(), 2u);
  EXPECT_EQ(apart.err, "1 fixed\n");
}

TEST(IsolintFix, MayLeaveNothing) {
  const CommandSetup only_line{.input = "G27\n"};
  EXPECT_EQ(run_command({"isolint", "--select", "W002", "--fix", "-"}, only_line).out, "");
  EXPECT_EQ(run_command({"isolint", "--select", "W002", "--diff", "-"}, only_line).out,
            "--- <stdin>\n+++ <stdin>\n@@ -1 +0,0 @@\n-G27\n");
}

TEST(IsolintFix, KeepsByteOrderMarksLineEndsAndForeignBytes) {
  const std::string before = "\xEF\xBB\xBFM06 T101001\r\nG70 G00 X1 (caf\xE9)\rG70\nG70 X2\r\nG00 X1 M02";
  const std::string after = "\xEF\xBB\xBFM06 T101001\r\nG70 G00 X1 (caf\xE9)\rX2\r\nG00 X1\r\nM02";
  EXPECT_EQ(run_on(before, {"--fix", "--ignore", "W"}).out, before.substr(0, before.size() - 4) + "\r\nM02");
  EXPECT_EQ(run_on(before, {"--fix"}).out, after);
  const support::TemporaryFolder folder;
  const std::string file = folder.write("part.iso", before);
  ::chmod(file.c_str(), 0640);
  EXPECT_EQ(run_command({"isolint", "--fix", file}).status, 0);
  EXPECT_EQ(text_of_file(file), after);
  struct stat status {};
  ::stat(file.c_str(), &status);
  EXPECT_EQ(status.st_mode & 0777u, 0640u);
}

TEST(IsolintFix, TouchesNothingThatStaysAsItIs) {
  const support::TemporaryFolder folder;
  const std::string file = folder.write("part.iso", kCleanProgram);
  ::chmod(file.c_str(), 0440);
  struct stat before {};
  struct stat after {};
  ::stat(file.c_str(), &before);
  const CommandResult result = run_command({"isolint", "--fix", file});
  ::stat(file.c_str(), &after);
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(before.st_ino, after.st_ino);
}

TEST(IsolintFix, ReportsThatAFileCannotBeReplaced) {
  const support::TemporaryFolder folder;
  const std::string file = folder.write("part.iso", kMendable);
  const std::string other = folder.write("other.iso", kMendable);
  std::filesystem::create_hard_link(file, folder.path("name.txt"));
  const CommandResult result = run_command({"isolint", "--fix", "--format", "concise", folder.path()});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, AllOf(HasSubstr("part.iso: "), HasSubstr("hard links"), HasSubstr("1 fixed\n")));
  EXPECT_EQ(text_of_file(file), kMendable);
  EXPECT_EQ(text_of_file(other), kSafelyMended);
  EXPECT_THAT(result.out, HasSubstr("part.iso:3:1: warning: G71 is already in force [W001]"));
  EXPECT_THAT(result.out, Not(HasSubstr("other.iso:3:1: ")));
}

TEST(IsolintFix, ReportsALostProgram) {
  for (const StandardOutput output : {StandardOutput::FullDisk, StandardOutput::ClosedPipe}) {
    const CommandResult result =
        run_command({"isolint", "--fix", "-"}, {.input = std::string(kMendable), .standard_output = output});
    EXPECT_EQ(result.status, 2);
    EXPECT_THAT(result.err, HasSubstr("<stdout>: cannot write"));
  }
}

TEST(IsolintFix, LeavesWhatIsNoProgram) {
  const CommandResult result = run_on("\xFF\xFEG", {"--fix"});
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.out, "");
}

TEST(IsolintFix, CountsWhatRemains) {
  EXPECT_EQ(run_on("M06 T101001\nG00 X1 M02\n", {"--fix"}).status, 0);
  EXPECT_EQ(run_on("M06 T101001\nG00 X1 M02\n", {}).status, 1);
  EXPECT_EQ(run_on("M06 T101001\nG71\nG71\nM02\n", {"--fix", "--max-warnings", "0"}).status, 0);
  EXPECT_EQ(run_on("M06 T101001\nG71\nG71\nM02\n", {"--max-warnings", "0"}).status, 1);
}

TEST(IsolintDiff, ShowsAndChangesNothing) {
  const support::TemporaryFolder folder;
  const std::string text = std::string(kMendable) + "(a)\n(b)\n(c)\n(d)\n(e)\n(f)\n(g)\n(h)\n(i)\n";
  const std::string file = folder.write("part.iso", text);
  for (const std::vector<std::string>& options :
       std::vector<std::vector<std::string>>{{"--diff"}, {"--diff", "--fix"}}) {
    std::vector<std::string> arguments = {"isolint", "part.iso"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const CommandResult result = run_command(arguments, {.folder = folder.path()});
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(result.out,
              "--- part.iso\n+++ part.iso\n"
              "@@ -1,6 +1,6 @@\n M06 T101001\n G71\n-G71 G00 X10,5 ; gi\xC3\xB9\n+G00 X10,5 ; gi\xC3\xB9\n"
              " G00 Y5 U5\n M02\n (a)\n");
    EXPECT_EQ(result.err, "2 errors, 0 warnings in 1 file; 1 would be fixed\n");
    EXPECT_EQ(text_of_file(file), text);
  }
}

TEST(IsolintDiff, ShowsLinesThatComeAndGo) {
  std::string filling;
  for (int i = 0; i < 9; ++i) filling += "X" + std::to_string(i) + "\n";
  const std::string text = "M06 T101001\nG00 X1\nG71\nG71\n" + filling + "G28 Y1 I-1 R1\nG92 X5\n" + filling + "G00 X5";
  const CommandResult result = run_on(text, {"--diff", "--unsafe-fixes"});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.out,
            "--- <stdin>\n+++ <stdin>\n"
            "@@ -1,7 +1,6 @@\n M06 T101001\n G00 X1\n G71\n-G71\n X0\n X1\n X2\n"
            "@@ -12,6 +11,7 @@\n X7\n X8\n G28 Y1 I-1 R1\n+G27\n G92 X5\n X0\n X1\n"
            "@@ -22,4 +22,5 @@\n X6\n X7\n X8\n-G00 X5\n\\ No newline at end of file\n+G00 X5\n+M02\n"
            "\\ No newline at end of file\n");
}

/// What patch makes of it is what --fix makes.
TEST(IsolintDiff, CanBeApplied) {
  int applied = 0;
  for (const auto& entry : std::filesystem::directory_iterator(ISOCNC_SOURCE_DIR "/examples/broken")) {
    const support::TemporaryFolder folder;
    const std::string patched = folder.write("patched.iso", text_of_file(entry.path()));
    const std::string fixed = folder.write("fixed.iso", text_of_file(entry.path()));
    const CommandResult diff =
        run_command({"isolint", "--diff", "--unsafe-fixes", "patched.iso"}, {.folder = folder.path()});
    run_command({"isolint", "--fix", "--unsafe-fixes", fixed});
    folder.write("difference", diff.out);
    if (!diff.out.empty()) {
      EXPECT_EQ(std::system(("cd " + folder.path() + " && git apply -p0 difference").c_str()), 0) << diff.out;
      ++applied;
    }
    EXPECT_EQ(text_of_file(patched), text_of_file(fixed)) << entry.path();
  }
  EXPECT_GT(applied, 10);
}

TEST(IsolintDiff, IsEmptyWhereNothingCanBeMended) {
  const CommandResult clean = run_on(std::string(kCleanProgram), {"--diff"});
  EXPECT_EQ(clean.status, 0);
  EXPECT_EQ(clean.out, "");
  const CommandResult broken = run_on("M06 T101001\nG00 X1 U5\nM02\n", {"--diff"});
  EXPECT_EQ(broken.status, 1);
  EXPECT_EQ(broken.out, "");
}

TEST(IsolintFix, RefusesMistakenCommands) {
  for (const std::vector<std::string>& options :
       std::vector<std::vector<std::string>>{{"--diff", "--format", "json"},
                                             {"--diff", "--statistics"},
                                             {"--fix", "--write-baseline", "known.json"},
                                             {"--diff", "--write-baseline", "known.json"}}) {
    const CommandResult result = run_on(std::string(kCleanProgram), options);
    EXPECT_EQ(result.status, 2) << testing::PrintToString(options);
    EXPECT_EQ(result.out, "");
  }
}

/// The edits of a finding as the JSON reports them, made on the lines of the program.
TEST(IsolintFixJson, ReportsEditsInCodePoints) {
  const CommandResult result = run_on("M06 T101001\n(\xC3\xA0\xE6\x9D\xB1) G00 X10,5\r\nG00 Y5",
                                      {"--format", "json", "--select", "ISO006,ISO045"});
  const json findings = json::parse(result.out);
  ASSERT_EQ(findings.size(), 2u);
  EXPECT_EQ(findings[0]["fix"], json::parse(R"({"title":"write 10.5","safe":false,
                            "edits":[{"line":2,"column":11,"endLine":2,"endColumn":15,"text":"10.5"}]})"));
  EXPECT_EQ(findings[1]["fix"]["edits"],
            json::parse(R"([{"line":3,"column":7,"endLine":3,"endColumn":7,"text":"\r\nM02"}])"));
  const CommandResult removed = run_on("M06 T101001\nG71\nG71\nM02\n", {"--format", "json"});
  EXPECT_EQ(json::parse(removed.out)[0]["fix"], json::parse(R"({"title":"remove G71, already in force","safe":true,
                            "edits":[{"line":3,"column":1,"endLine":4,"endColumn":1,"text":""}]})"));
  EXPECT_EQ(json::parse(run_on(std::string(kBrokenProgram), {"--format", "json"}).out)[0]["fix"], nullptr);
}

TEST(IsolintFixSarif, ReportsReplacements) {
  const CommandResult result = run_on("M06 T101001\nG71\nG71\nM02\n", {"--format", "sarif"});
  const json sarif = json::parse(result.out);
  const json& fixes = sarif["runs"][0]["results"][0].at("fixes");
  ASSERT_EQ(fixes.size(), 1u);
  EXPECT_EQ(fixes[0].at("description").at("text"), "remove G71, already in force");
  const json& change = fixes[0].at("artifactChanges").at(0);
  EXPECT_EQ(change.at("artifactLocation").at("index"), 0);
  EXPECT_EQ(change.at("replacements"),
            json::parse(R"([{"deletedRegion":{"startLine":3,"startColumn":1,"endLine":4,"endColumn":1},
                             "insertedContent":{"text":""}}])"));
}

/// An error on each line, far apart and all together: one check for each round, not for each fix.
TEST(IsolintFix, MendsLargePrograms) {
  std::string program = "M06 T101001\n";
  std::string expected = program;
  for (int i = 0; i < 300'000; ++i) {
    program += "G00 X" + std::to_string(i % 100) + " S500 Y5\n";
    expected += "G00 X" + std::to_string(i % 100) + " Y5 S500\n";
  }
  const CommandResult result = run_on(program + "M02\n", {"--fix"});
  EXPECT_EQ(result.status, 0);
  EXPECT_TRUE(result.out == expected + "M02\n");
}

}  // namespace
}  // namespace isocnc::commands
