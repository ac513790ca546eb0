#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>

#include "programs.h"
#include "run_command.h"
#include "tests/support/temporary_folder.h"

namespace isocnc::commands {
namespace {

using testing::HasSubstr;
using testing::MatchesRegex;
using testing::StartsWith;

TEST(IsolintStatus, ExitStatusDistinguishesErrorsWarningsAndFailure) {
  EXPECT_EQ(run_command({"isolint", "-"}, {.input = std::string(kCleanProgram)}).status, 0);
  EXPECT_EQ(run_command({"isolint", "-"}, {.input = std::string(kWarnedProgram)}).status, 0);
  EXPECT_EQ(run_command({"isolint", "-"}, {.input = std::string(kBrokenProgram)}).status, 1);
  EXPECT_EQ(run_command({"isolint", "no-such-file.iso"}).status, 2);
}

TEST(IsolintStatus, CountsWarningsAside) {
  const CommandResult result = run_command({"isolint", "-"}, {.input = std::string(kWarnedProgram)});
  EXPECT_THAT(result.out, StartsWith("warning[W001]: G71 is already in force\n"));
  EXPECT_EQ(result.err, "0 errors, 1 warning in 1 file\n");
}

TEST(IsolintUsage, RefusesWhatItDoesNotKnow) {
  const std::vector<std::vector<std::string>> mistakes = {
      {"isolint", "--no-such-option"},  {"isolint", "--format", "xml", "-"},
      {"isolint", "--lang", "de", "-"}, {"isolint", "--color", "maybe", "-"},
      {"isolint", "--jobs", "0", "-"},  {"isolint", "--jobs", "two", "-"},
      {"isolint", "--format"},          {"isolint", "-", "-"},
      {"isolint", "-", "other.iso"}};
  for (const auto& mistake : mistakes) {
    const CommandResult result = run_command(mistake, {.input = std::string(kCleanProgram)});
    EXPECT_EQ(result.status, 2) << testing::PrintToString(mistake);
    EXPECT_EQ(result.out, "") << testing::PrintToString(mistake);
    EXPECT_THAT(result.err, StartsWith("isolint: ")) << testing::PrintToString(mistake);
  }
}

TEST(IsolintUsage, GuessesTheOptionThatWasMeant) {
  EXPECT_THAT(run_command({"isolint", "--fromat=json"}).err,
              StartsWith("isolint: no such option: --fromat; did you mean --format?\n"));
  EXPECT_THAT(run_command({"isolint", "--stat"}).err, HasSubstr("did you mean --statistics?"));
  EXPECT_THAT(run_command({"isolint", "--format", "jsno"}).err, HasSubstr("did you mean json?"));
  EXPECT_THAT(run_command({"isolint", "--quaternion"}).err, StartsWith("isolint: no such option: --quaternion\n"));
}

TEST(IsolintUsage, NamesItsVersion) {
  const CommandResult result = run_command({"isolint", "--version"});
  EXPECT_THAT(result.out, MatchesRegex("isolint [0-9]+\\.[0-9]+\\.[0-9]+\n"));
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(result.status, 0);
}

TEST(IsolintUsage, HelpNamesEveryOption) {
  const CommandResult result = run_command({"isolint", "--help"});
  EXPECT_EQ(result.status, 0);
  for (const std::string option :
       {"--format",     "--lang",      "--color",          "--jobs",         "--stdin-filename", "--explain",
        "--list-rules", "--no-config", "--version",        "--help",         "--select",         "--ignore",
        "--severity",   "--baseline",  "--write-baseline", "--max-warnings", "--exit-zero",      "--output",
        "--statistics", "--config",    "--show-config"})
    EXPECT_THAT(result.out, HasSubstr(option));
}

TEST(IsolintExplain, PrintsAllAboutACode) {
  const CommandResult result = run_command({"isolint", "--explain", "ISO031"});
  EXPECT_THAT(result.out, StartsWith("ISO031 arc-center-mismatch (error, specification I.3.4.3.a)\n"));
  EXPECT_THAT(result.out, HasSubstr("\nWrong:\n"));
  EXPECT_THAT(result.out, HasSubstr("\nRight:\n"));
  EXPECT_EQ(result.status, 0);
}

TEST(IsolintExplain, KnowsCodesInLowerCaseAndNames) {
  const std::string expected = run_command({"isolint", "--explain", "ISO031"}).out;
  EXPECT_EQ(run_command({"isolint", "--explain", "iso031"}).out, expected);
  EXPECT_EQ(run_command({"isolint", "--explain", "arc-center-mismatch"}).out, expected);
}

TEST(IsolintExplain, SpeaksItalian) {
  const CommandResult result = run_command({"isolint", "--explain", "ISO031", "--lang", "it"});
  EXPECT_THAT(result.out, StartsWith("ISO031 arc-center-mismatch (errore, specifica I.3.4.3.a)\n"));
  EXPECT_THAT(result.out, HasSubstr("\nGiusto:\n"));
}

TEST(IsolintExplain, NamesTheKeyOfTheConfiguration) {
  EXPECT_THAT(run_command({"isolint", "--explain", "W115"}).out,
              testing::EndsWith("\nOption in isocnc.json: lint.options.longestDwell, else 120 s\n"));
  EXPECT_THAT(run_command({"isolint", "--lang", "it", "--explain", "W115"}).out,
              testing::EndsWith("\nOpzione in isocnc.json: lint.options.longestDwell, altrimenti 120 s\n"));
  EXPECT_THAT(run_command({"isolint", "--explain", "W001"}).out, testing::Not(testing::HasSubstr("isocnc.json")));
}

TEST(IsolintExplain, SaysSoWhenThereIsNoSuchCode) {
  for (const std::string code : {"ISO069", "W", "x"}) {
    const CommandResult result = run_command({"isolint", "--explain", code});
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(result.err, "isolint: unknown code: " + code + " (--list-rules)\n");
  }
}

TEST(IsolintExplain, GuessesTheCodeThatWasMeant) {
  EXPECT_EQ(run_command({"isolint", "--explain", "ISO31"}).err,
            "isolint: unknown code: ISO31; did you mean ISO031? (--list-rules)\n");
  EXPECT_EQ(run_command({"isolint", "--lang", "it", "--explain", "feed-mising"}).err,
            "isolint: codice sconosciuto: feed-mising; forse feed-missing? (--list-rules)\n");
}

TEST(IsolintListRules, ListsEveryCodeOnALine) {
  const CommandResult result = run_command({"isolint", "--list-rules"});
  EXPECT_EQ(result.status, 0);
  for (const std::string code : {"ISO001", "ISO068", "E001", "E009", "W001", "W003", "W191", "W192"})
    EXPECT_THAT("\n" + result.out, HasSubstr("\n" + code + " ")) << code;
  EXPECT_THAT(result.out, HasSubstr("error "));
  EXPECT_THAT(run_command({"isolint", "--list-rules", "--lang", "it"}).out, HasSubstr("errore "));
}

struct Saying {
  std::string name;
  std::vector<std::string> command;

  friend std::ostream& operator<<(std::ostream& out, const Saying& saying) { return out << saying.name; }
};

/// What was asked for and could not be said is no success.
class IsolintOutput : public testing::TestWithParam<Saying> {
 protected:
  static CommandResult write_to(StandardOutput output) {
    return run_command(GetParam().command, {.input = std::string(kBrokenProgram), .standard_output = output});
  }
};

TEST_P(IsolintOutput, FailsOnAFullDisk) {
  const CommandResult result = write_to(StandardOutput::FullDisk);
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("isolint: "));
}

TEST_P(IsolintOutput, FailsOnAClosedPipe) {
  const CommandResult result = write_to(StandardOutput::ClosedPipe);
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("isolint: "));
}

INSTANTIATE_TEST_SUITE_P(Commands, IsolintOutput,
                         testing::Values(Saying{"Text", {"isolint", "-"}},
                                         Saying{"Concise", {"isolint", "--format", "concise", "-"}},
                                         Saying{"Json", {"isolint", "--format", "json", "-"}},
                                         Saying{"Sarif", {"isolint", "--format", "sarif", "-"}},
                                         Saying{"Junit", {"isolint", "--format", "junit", "-"}},
                                         Saying{"ListRules", {"isolint", "--list-rules"}},
                                         Saying{"Explain", {"isolint", "--explain", "ISO031"}},
                                         Saying{"RulesPage", {"isolint", "--rules-page"}},
                                         Saying{"MessagesPage", {"isolint", "--messages-page"}},
                                         Saying{"NotepadLanguage", {"isolint", "--notepad-language"}},
                                         Saying{"ForeignPage", {"isolint", "--foreign-page"}},
                                         Saying{"Version", {"isolint", "--version"}},
                                         Saying{"Help", {"isolint", "--help"}}),
                         [](const auto& tested) { return tested.param.name; });

TEST(IsolintOutputMessage, SaysWhyInTheReadersLanguage) {
  const CommandResult english = run_command(
      {"isolint", "-"}, {.input = std::string(kBrokenProgram), .standard_output = StandardOutput::FullDisk});
  EXPECT_EQ(english.err, "isolint: <stdout>: cannot write: No space left on device\n");
  const CommandResult italian =
      run_command({"isolint", "--lang", "it", "-"},
                  {.input = std::string(kBrokenProgram), .standard_output = StandardOutput::FullDisk});
  EXPECT_EQ(italian.err, "isolint: <stdout>: non si può scrivere: spazio su disco esaurito\n");
}

}  // namespace
}  // namespace isocnc::commands
