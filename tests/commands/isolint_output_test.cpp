#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <utility>

#include <nlohmann/json.hpp>

#include "programs.h"
#include "run_command.h"
#include "tests/support/temporary_folder.h"

namespace isocnc::commands {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

/// Checks a program from standard input and returns the array that `--format json` prints.
json findings_in(std::string_view program, std::vector<std::string> options = {}) {
  options.insert(options.begin(), {"isolint", "--format", "json", "-"});
  return json::parse(run_command(options, {.input = std::string(program)}).out);
}

TEST(IsolintText, ShowsTheLineItsMarkAndTheReason) {
  const CommandResult result = run_command({"isolint", "-"}, {.input = std::string(kBrokenProgram)});
  EXPECT_EQ(
      result.out,
      "error[ISO026]: G01 has no coordinate: write at least one directly after it\n"
      " --> <stdin>:3:1\n"
      "  |\n"
      "3 | G01\n"
      "  | ^^^\n"
      "  = A motion G needs at least one coordinate directly after it, even if it is meant for the lines that follow.\n"
      "\n");
  EXPECT_EQ(result.err, "1 error, 0 warnings in 1 file\n");
  EXPECT_EQ(result.status, 1);
}

TEST(IsolintText, SaysNothingOfACleanProgramButTheCount) {
  const CommandResult result = run_command({"isolint", "-"}, {.input = std::string(kCleanProgram)});
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err, "0 errors, 0 warnings in 1 file\n");
  EXPECT_EQ(result.status, 0);
}

/// A name, too, may hold what a terminal would obey.
TEST(IsolintText, ShowsNamesAsTextAndNothingElse) {
  const support::TemporaryFolder folder;
  folder.write("a\033[31m\nb.iso", kBrokenProgram);
  for (const std::string format : {"text", "concise"}) {
    const CommandResult result = run_command({"isolint", "--format", format, "."}, {.folder = folder.path()});
    EXPECT_THAT(result.out, HasSubstr("a\xEF\xBF\xBD[31m\xEF\xBF\xBD"
                                      "b.iso:3:1"))
        << format;
    EXPECT_THAT(result.out, Not(HasSubstr("\033"))) << format;
  }
}

TEST(IsolintText, NamesTheOtherPlaceOnTheLine) {
  const CommandResult result = run_command({"isolint", "-"}, {.input = "M06 T101001\nG01 X10 F100 F200\nM02\n"});
  EXPECT_THAT(result.out, HasSubstr("2 | G01 X10 F100 F200\n  |         ---- ^^^^  (--- the other place)\n"));
}

TEST(IsolintText, NamesTheLineAboveThatAFindingComesFrom) {
  std::string program = "M06 T101001\nG29 C90\n";
  for (int i = 0; i < 8; ++i) program += "G00 X10\n";
  const CommandResult result = run_command({"isolint", "-"}, {.input = program + "G92 X0 Y0 Z0\nM02\n"});
  EXPECT_THAT(result.out, HasSubstr("  --> <stdin>:11:1\n"
                                    "   |\n"
                                    " 2 | G29 C90\n"
                                    "   | --- the face frame was mounted here\n"
                                    "...\n"
                                    "11 | G92 X0 Y0 Z0\n"
                                    "   | ^^^\n"));
}

TEST(IsolintText, PutsNothingBetweenTheLineAboveAndTheNext) {
  const CommandResult result = run_command(
      {"isolint", "--lang", "it", "-"}, {.input = "M06 T101001\nIF VGPL = 1 GOTO N20\nN20 M03\n (x) N20 M05\nM02\n"});
  EXPECT_THAT(result.out, HasSubstr("3 | N20 M03\n"
                                    "  | --- l'etichetta c'è già qui\n"
                                    "4 |  (x) N20 M05\n"
                                    "  |      ^^^\n"));
}

TEST(IsolintText, ShowsAPieceOfALongLineAroundTheMark) {
  const std::string program = "M06 T101001 (" + std::string(500, 'a') + ") U5 ;" + std::string(500, 'b') + "\nM02\n";
  const CommandResult result = run_command({"isolint", "-"}, {.input = program});
  EXPECT_THAT(result.out, HasSubstr("1 | ...aaaa"));
  EXPECT_THAT(result.out, HasSubstr("bbb...\n"));
  EXPECT_THAT(result.out, HasSubstr("^^"));
  EXPECT_THAT(result.out, Not(HasSubstr(std::string(200, 'a'))));
}

TEST(IsolintText, MarksTheColumnThatTheReaderSees) {
  const CommandResult result = run_command({"isolint", "-"}, {.input = "(càvo 東) M03 M02\n"});
  EXPECT_THAT(result.out, HasSubstr("<stdin>:1:14\n"));
  EXPECT_THAT(result.out, HasSubstr("1 | (càvo 東) M03 M02\n  |              ^^^\n"));
}

/// A program is a stranger's text: what it holds must not reach the terminal as a command.
TEST(IsolintText, LetsNoControlCharacterThrough) {
  // So much plain text that it is no binary file.
  const std::string program = "M06 T101001 (" + std::string(200, 'a') +
                              ")\n\x1b]0;title\x07 (\xC2\x9B"
                              "31m) \x7f\b\nM02\n";
  for (const std::string format : {"text", "concise"}) {
    const CommandResult result = run_command({"isolint", "--format", format, "-"}, {.input = program});
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(result.out.find_first_of("\x1b\x07\x7f\b"), std::string::npos) << result.out;
    EXPECT_THAT(result.out, Not(HasSubstr("\xC2\x9B")));
  }
}

/// What looks like a blank, or like nothing, is called by its number.
TEST(IsolintText, NamesWhatCannotBeSeen) {
  const json found = findings_in("M06 T101001\nG00 X10 \u00a0\nG00 X20 a\u200bb\nM02\n", {"--no-config"});
  ASSERT_GE(found.size(), 1u);
  EXPECT_THAT(found[0]["message"].get<std::string>(), StartsWith("U+00A0 "));
  EXPECT_THAT(found.dump(), HasSubstr("U+200B"));
}

TEST(IsolintText, NamesTheAxisThatGoesTooFar) {
  const support::TemporaryFolder folder;
  const std::string machine =
      folder.write("m.json", R"({"machine": {"axes": {"Y": {"max": 100}, "C": {"min": -90}}}})");
  const json found = findings_in("M06 T101001\nG00 Y150\nG00 Y0 C-91\nM02\n", {"--config", machine});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0]["message"], "Y goes to 150 in machine coordinates, and its travel ends at 100");
  EXPECT_THAT(found[1]["message"].get<std::string>(), StartsWith("C goes to -91 in machine coordinates"));
}

TEST(IsolintConcise, PrintsOneLineForEachFinding) {
  const CommandResult result = run_command({"isolint", "--format", "concise", "--select", "ISO", "-"},
                                           {.input = "M06 T101001\nG01 X10\n(é) M03 M02\nM02\n"});
  EXPECT_EQ(result.out,
            "<stdin>:2:1: error: G01 has no feed rate: no F has been given so far [ISO066]\n"
            "<stdin>:3:9: error: M02 must stand alone on its line, without M03 [ISO043]\n");
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(result.status, 1);
}

TEST(IsolintJson, IsAnEmptyArrayForACleanProgram) { EXPECT_EQ(findings_in(kCleanProgram), json::array()); }

TEST(IsolintJson, HasEveryKeyInItsOrder) {
  const CommandResult result = run_command({"isolint", "--format", "json", "--stdin-filename", "part.iso", "-"},
                                           {.input = std::string(kBrokenProgram)});
  EXPECT_EQ(result.err, "");
  const auto findings = nlohmann::ordered_json::parse(result.out);
  ASSERT_EQ(findings.size(), 1u);
  std::vector<std::string> keys;
  for (const auto& [key, value] : findings[0].items()) keys.push_back(key);
  EXPECT_THAT(keys, ElementsAre("file", "line", "column", "endLine", "endColumn", "severity", "code", "name", "message",
                                "url", "fix", "path"));
  const json expected = {{"file", "part.iso"},
                         {"line", 3},
                         {"column", 1},
                         {"endLine", 3},
                         {"endColumn", 4},
                         {"severity", "error"},
                         {"code", "ISO026"},
                         {"name", "missing-coordinate"},
                         {"message", "G01 has no coordinate: write at least one directly after it"},
                         {"fix", nullptr},
                         {"path", nullptr}};
  for (const auto& [key, value] : expected.items()) EXPECT_EQ(json(findings[0][key]), value) << key;
  EXPECT_THAT(findings[0]["url"].get<std::string>(), testing::EndsWith("docs/rules.md#iso026-missing-coordinate"));
}

/// The files that findings of a format name, in their order.
std::vector<std::string> files_named_by(const std::string& format, const std::string& folder) {
  const CommandResult result =
      run_command({"isolint", "--format", format, "b.iso", "sub", "a.iso", "B.iso", "a/c.iso"}, {.folder = folder});
  std::vector<std::string> files;
  if (format == "json") {
    for (const json& finding : json::parse(result.out)) files.push_back(finding["file"]);
  } else {
    std::istringstream lines(result.out);
    for (std::string line; std::getline(lines, line);) files.push_back(line.substr(0, line.find(':')));
  }
  return files;
}

TEST(IsolintJson, IsSortedByFileWhateverTheOrderGiven) {
  const support::TemporaryFolder folder;
  for (const std::string name : {"a.iso", "a/c.iso", "b.iso", "B.iso", "sub/a.iso"}) folder.write(name, kBrokenProgram);
  EXPECT_THAT(files_named_by("json", folder.path()), ElementsAre("B.iso", "a.iso", "a/c.iso", "b.iso", "sub/a.iso"));
  EXPECT_THAT(files_named_by("concise", folder.path()), ElementsAre("b.iso", "sub/a.iso", "a.iso", "B.iso", "a/c.iso"));
}

TEST(IsolintJson, IsSortedByLineAndColumn) {
  const json findings = findings_in("M06 T101001\nG00 X1 H2 (é) D3\nG00 H2 X1 D1\nG01\nM02\n");
  std::vector<std::pair<int, int>> places;
  for (const json& finding : findings) places.emplace_back(finding["line"], finding["column"]);
  EXPECT_GE(places.size(), 5u);
  EXPECT_TRUE(std::is_sorted(places.begin(), places.end())) << findings;
}

TEST(IsolintJson, CountsColumnsInCodePoints) {
  // Two, three and four bytes each, then a stray byte, which counts as one.
  const json finding = findings_in("(àé 東 \U0001F527 \xFF) M03 M02\n", {"--select", "ISO"}).at(0);
  EXPECT_EQ(finding["column"], 16);
  EXPECT_EQ(finding["endColumn"], 19);
}

TEST(IsolintJson, CountsColumnsAfterAByteOrderMark) {
  EXPECT_EQ(findings_in("\xEF\xBB\xBFM03 M02\n", {"--select", "ISO"}).at(0)["column"], 5);
}

TEST(IsolintJson, CountsLinesAtEachKindOfLineEnd) {
  const json findings = findings_in("M06 T101001\rG00 U1\r\nG00 U2\n\nG00 U3\nM02");
  std::vector<int> lines;
  for (const json& finding : findings)
    if (finding["code"] == "ISO003") lines.push_back(finding["line"]);
  EXPECT_THAT(lines, ElementsAre(2, 3, 5));
}

TEST(IsolintJson, KeepsMessagesValidWhateverTheProgramHolds) {
  const json findings = findings_in(std::string("M06 T101001\n\xFF\"\\\0\x01\nM02\n", 20));
  ASSERT_FALSE(findings.empty());
  EXPECT_EQ(findings[0]["code"], "ISO003");
}

TEST(IsolintJson, SpeaksTheReadersLanguageInMessagesAlone) {
  const json finding = findings_in(kBrokenProgram, {"--lang", "it"}).at(0);
  EXPECT_EQ(finding["severity"], "error");
  EXPECT_EQ(finding["name"], "missing-coordinate");
  EXPECT_EQ(finding["message"], "G01 senza alcuna quota: scriverne almeno una subito dopo");
}

constexpr std::string_view kForkedProgram =
    "M06 T101001\n"
    "G00 Z5\n"
    "IF VGPL = 1 GOTO N40\n"
    "G01 F500 X10\n"
    "N40 G01 X20\n"
    "M02\n";

TEST(IsolintJson, NamesTheJumpsThroughWhichAFindingIsReached) {
  const json findings = findings_in(kForkedProgram);
  ASSERT_EQ(findings.size(), 1u) << findings;
  EXPECT_EQ(findings[0]["code"], "ISO066");
  EXPECT_EQ(findings[0]["path"], json::parse(R"([{"line": 3, "text": "IF VGPL = 1 GOTO N40: jumps"}])"));
}

TEST(IsolintText, NamesTheJumpsThroughWhichAFindingIsReached) {
  const CommandResult result = run_command({"isolint", "--lang", "it", "-"}, {.input = std::string(kForkedProgram)});
  EXPECT_THAT(result.out, HasSubstr("solo su questo percorso:\n      3: IF VGPL = 1 GOTO N40: salta\n"));
}

struct LocaleCase {
  std::map<std::string, std::string> environment;
  bool italian;
};

TEST(IsolintLanguage, FollowsTheLocale) {
  const LocaleCase cases[] = {
      {{}, false},
      {{{"LANG", "it_IT.UTF-8"}}, true},
      {{{"LANG", "it"}}, true},
      {{{"LANG", "it.UTF-8"}}, true},
      {{{"LANG", "it_CH@euro"}}, true},
      {{{"LANG", "en_US.UTF-8"}}, false},
      {{{"LANG", "C"}}, false},
      {{{"LANG", "ita"}}, false},
      {{{"LC_MESSAGES", "it_IT.UTF-8"}}, true},
      {{{"LC_MESSAGES", "it_IT"}, {"LANG", "en_US"}}, true},
      {{{"LC_MESSAGES", "en_US"}, {"LANG", "it_IT"}}, false},
      {{{"LC_ALL", "it_IT"}, {"LC_MESSAGES", "en_US"}, {"LANG", "en_US"}}, true},
      {{{"LC_ALL", "C"}, {"LC_MESSAGES", "it_IT"}, {"LANG", "it_IT"}}, false},
      {{{"LC_ALL", ""}, {"LANG", "it_IT"}}, true},
      {{{"LC_NUMERIC", "it_IT"}}, false},
  };
  for (const LocaleCase& each : cases) {
    const CommandResult result =
        run_command({"isolint", "-"}, {.input = std::string(kBrokenProgram), .environment = each.environment});
    EXPECT_THAT(result.out, StartsWith(each.italian ? "errore[ISO026]" : "error[ISO026]"))
        << testing::PrintToString(each.environment);
  }
}

TEST(IsolintLanguage, IsWhatTheOptionSays) {
  const CommandSetup italian{.input = std::string(kBrokenProgram), .environment = {{"LC_ALL", "it_IT.UTF-8"}}};
  EXPECT_THAT(run_command({"isolint", "--lang", "en", "-"}, italian).out, StartsWith("error["));
  const CommandResult result = run_command({"isolint", "--lang", "it", "-"}, {.input = std::string(kBrokenProgram)});
  EXPECT_THAT(result.out, StartsWith("errore[ISO026]: G01 senza alcuna quota: scriverne almeno una subito dopo\n"));
  EXPECT_EQ(result.err, "1 errore, 0 avvisi in 1 file\n");
}

TEST(IsolintColor, IsForTerminalsUnlessAskedFor) {
  const CommandSetup broken{.input = std::string(kBrokenProgram)};
  EXPECT_THAT(run_command({"isolint", "-"}, broken).out, Not(HasSubstr("\x1b")));
  EXPECT_THAT(run_command({"isolint", "--color", "auto", "-"}, broken).out, Not(HasSubstr("\x1b")));
  EXPECT_THAT(run_command({"isolint", "--color", "never", "-"}, broken).out, Not(HasSubstr("\x1b")));
  EXPECT_THAT(run_command({"isolint", "--color", "always", "-"}, broken).out,
              StartsWith("\x1b[1;31merror[ISO026]\x1b[0m"));
}

TEST(IsolintColor, ChangesNothingButColors) {
  const CommandSetup broken{.input = std::string(kBrokenProgram)};
  std::string colored = run_command({"isolint", "--color", "always", "-"}, broken).out;
  for (std::size_t at = colored.find('\x1b'); at != std::string::npos; at = colored.find('\x1b'))
    colored.erase(at, colored.find('m', at) + 1 - at);
  EXPECT_EQ(colored, run_command({"isolint", "-"}, broken).out);
}

}  // namespace
}  // namespace isocnc::commands
