#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <regex>
#include <sstream>

#include "run_command.h"

namespace isocnc::commands {
namespace {

using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// What all our programs answer in the same way.
class Program : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, Program, testing::Values("isolint", "isofmt", "isorun", "isodiff", "isols"),
                         [](const auto& program) { return program.param; });

TEST_P(Program, HelpFitsTheScreen) {
  const std::string help = run_command({GetParam(), "--help"}).out;
  EXPECT_THAT(help, Not(AnyOf(HasSubstr("\n\n\n"), HasSubstr("Excludes"))));
  const std::vector<std::string> lines = lines_of(help);
  for (const std::string& line : lines) EXPECT_LE(line.size(), 80u) << line;
  EXPECT_LE(lines.size(), 60u);
  EXPECT_GE(lines.size(), 10u);
}

/// Columns as a screen counts them.
std::size_t width_of(const std::string& line) {
  return static_cast<std::size_t>(
      std::count_if(line.begin(), line.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

TEST_P(Program, SpeaksItalianInItsHelp) {
  for (const CommandResult& result :
       {run_command({GetParam(), "--lang", "it", "--help"}), run_command({GetParam(), "--help", "--lang=it"}),
        run_command({GetParam(), "--help"}, {.environment = {{"LANG", "it_IT.UTF-8"}}})}) {
    EXPECT_THAT(result.out, HasSubstr("\nUso: " + GetParam() + " "));
    EXPECT_THAT(result.out, HasSubstr("Mostra questo aiuto"));
    EXPECT_THAT(result.out, HasSubstr("en o it; altrimenti"));
    for (const char* const english : {"Usage", "Options", "Print", " the "})
      EXPECT_THAT(result.out, testing::Not(HasSubstr(english)));
    for (const std::string& line : lines_of(result.out)) EXPECT_LE(width_of(line), 80u) << line;
  }
  EXPECT_THAT(run_command({GetParam(), "--lang", "en", "--help"}, {.environment = {{"LANG", "it_IT.UTF-8"}}}).out,
              HasSubstr("Usage: " + GetParam()));
  EXPECT_THAT(run_command({GetParam(), "--manual-page"}, {.environment = {{"LANG", "it_IT.UTF-8"}}}).out,
              HasSubstr("Print this help message"));
}

/// Wherever the mistake stands: before what sets the language, or where that cannot be read any more.
TEST_P(Program, ComplainsInItalian) {
  EXPECT_THAT(run_command({GetParam(), "--lang", "it", "--langg"}).err, HasSubstr("opzione sconosciuta: --langg"));
  EXPECT_THAT(run_command({GetParam(), "--langg", "--lang=it"}).err, HasSubstr("opzione sconosciuta: --langg"));
}

TEST(IsolintCommand, ComplainsOfValuesInItalian) {
  EXPECT_THAT(run_command({"isolint", "--lang", "it", "--jobs"}).err, HasSubstr("--jobs: manca il valore"));
  EXPECT_THAT(run_command({"isofmt", "--lang", "it", "--decimals", "x", "a.iso"}).err,
              HasSubstr("--decimals: x non c'è, solo 0, 1, "));
  EXPECT_THAT(run_command({"isolint", "--lang", "it", "--output", "", "a.iso"}).err, HasSubstr("--output: "));
}

TEST(IsolintCommand, ComplainsOfWhatDoesNotGoTogetherInItalian) {
  const auto said = [](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin() + 1, {"--lang", "it"});
    const CommandResult result = run_command(std::move(arguments));
    EXPECT_EQ(result.status, 2);
    return result.err.substr(0, result.err.find('\n'));
  };
  EXPECT_EQ(said({"isolint", "--config", "a", "--no-config", "b"}), "isolint: --config e --no-config si escludono");
  EXPECT_EQ(said({"isorun", "--dt", "1", "a.iso"}), "isorun: --dt richiede --samples");
  EXPECT_EQ(said({"isorun"}), "isorun: manca un argomento obbligatorio: FILE");
  EXPECT_EQ(said({"isorun", "a.iso", "b.iso"}), "isorun: argomento di troppo: b.iso");
  EXPECT_EQ(said({"isorun", "--vgpl", "1", "--vgpl=2", "a.iso"}), "isorun: --vgpl: dato più di una volta");
  EXPECT_EQ(said({"isolint", "--max-warnings", "few"}),
            "isolint: --max-warnings: few non è un numero intero da 0 a 999999999");
}

/// The same faults in English: none of the sentences is the library's.
TEST(IsolintCommand, ComplainsOfWhatDoesNotGoTogetherInEnglish) {
  const auto complaint_about = [](const std::vector<std::string>& arguments) {
    const CommandResult result = run_command(arguments);
    EXPECT_EQ(result.status, 2);
    return result.err.substr(0, result.err.find('\n'));
  };
  EXPECT_EQ(complaint_about({"isolint", "--config", "a", "--no-config", "b"}),
            "isolint: --config excludes --no-config");
  EXPECT_EQ(complaint_about({"isorun", "--dt", "1", "a.iso"}), "isorun: --dt requires --samples");
  EXPECT_EQ(complaint_about({"isorun"}), "isorun: FILE is required");
  EXPECT_EQ(complaint_about({"isorun", "a.iso", "b.iso"}), "isorun: unexpected argument: b.iso");
  EXPECT_EQ(complaint_about({"isolint", "--jobs"}), "isolint: --jobs: the value is missing");
  EXPECT_EQ(complaint_about({"isolint", "a", "--output"}), "isolint: --output: the value is missing");
  EXPECT_EQ(complaint_about({"isolint", "-j", "0"}), "isolint: --jobs: 0 is not a whole number from 1 to 1024");
  EXPECT_EQ(complaint_about({"isolint", "--max-warnings", "-1"}),
            "isolint: --max-warnings: -1 is not a whole number from 0 to 999999999");
  EXPECT_EQ(complaint_about({"isols", "--tcp", "70000"}), "isols: --tcp: 70000 is not a whole number from 0 to 65535");
}

TEST(IsolintCommand, TakesAnOptionOnce) {
  const CommandResult result = run_command({"isorun", "--vgpl", "1", "--vgpl", "2", "a.iso"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, StartsWith("isorun: --vgpl: given more than once\n"));
}

TEST(IsolintCommand, WantsANameForItsOutput) {
  const CommandResult result = run_command({"isolint", "--output", "", "-"}, {.input = "M02\n"});
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(result.err, HasSubstr("--output"));
}

/// One of two equally near numbers would mislead, and so would an option that --help does not list.
TEST(IsolintCommand, GuessesWhatCanBeMeant) {
  const std::string decimals = run_command({"isofmt", "--decimals", "99", "a.iso"}).err;
  EXPECT_THAT(decimals, HasSubstr("there is no 99, only 0, 1, "));
  EXPECT_THAT(decimals, testing::Not(HasSubstr("did you mean")));
  EXPECT_THAT(run_command({"isolint", "--rules"}).err, testing::Not(HasSubstr("--rules-page")));
  EXPECT_THAT(run_command({"isolint", "--frmt", "json"}).err, HasSubstr("did you mean --format?"));
}

TEST_P(Program, GuessesTheOptionThatWasMeant) {
  const CommandResult result = run_command({GetParam(), "--stdin-filenam=a", "--langg"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(run_command({GetParam(), "--langg=it"}).err,
              StartsWith(GetParam() + ": no such option: --langg; did you mean --lang?\n" + GetParam() + " --help\n"));
}

TEST_P(Program, ManualPageIsTheOneThatIsInstalled) {
  for (const auto& [folder, language] : {std::pair("docs/man/", "en"), std::pair("docs/man/it/", "it")}) {
    const std::string file = folder + GetParam() + ".1";
    std::stringstream installed;
    installed << std::ifstream(ISOCNC_SOURCE_DIR "/" + file, std::ios::binary).rdbuf();
    // The installation fills in the version.
    static const std::regex kVersion(R"("isocnc [0-9.]+")");
    const std::string page = run_command({GetParam(), "--lang", language, "--manual-page"}).out;
    EXPECT_EQ(std::regex_replace(page, kVersion, R"("isocnc @PROJECT_VERSION@")"), installed.str())
        << "write it anew: " << GetParam() << " --lang " << language
        << " --manual-page | sed '1s/isocnc [0-9.]*/isocnc @PROJECT_VERSION@/' > " << file;
  }
}

/// What a line of a manual page has in all languages: its request, or its options without the names of their values.
std::string common_part(const std::string& line) {
  if (line.starts_with('.')) return line.substr(0, line.find(' '));
  return line.starts_with("\\fB") ? line.substr(0, line.find("\\fI")) : "";
}

/// Whether a line is a sentence, in which words follow each other: no request, option, exit status or list of values.
bool is_sentence(const std::string& line) {
  static const std::regex kWords("[a-z]{2,} [a-z]{2,}");
  return !line.starts_with('.') && !line.starts_with("\\f") && std::regex_search(line, kWords);
}

TEST_P(Program, ManualPageIsInItalianThroughout) {
  const std::vector<std::string> english = lines_of(run_command({GetParam(), "--manual-page"}).out);
  using Command = std::vector<std::string>;
  for (const Command& command :
       {Command{GetParam(), "--lang=it", "--manual-page"}, Command{GetParam(), "--manual-page", "--lang", "it"}}) {
    const std::vector<std::string> italian = lines_of(run_command(command).out);
    ASSERT_EQ(italian.size(), english.size());
    for (std::size_t i = 0; i < english.size(); ++i) {
      EXPECT_EQ(common_part(italian[i]), common_part(english[i]));
      const bool is_heading = english[i].starts_with(".S");
      EXPECT_TRUE(italian[i] != english[i] || !(is_heading || is_sentence(english[i]))) << english[i];
    }
  }
}

TEST_P(Program, CompletesOptionsAndLanguages) {
  const auto complete = [&](const std::string& word, const std::string& previous) {
    return lines_of(run_command({GetParam(), "--complete", GetParam(), word, previous}).out);
  };
  EXPECT_THAT(complete("--la", GetParam()), testing::ElementsAre("--lang"));
  EXPECT_THAT(complete("", "--lang"), testing::ElementsAre("en", "it"));
  EXPECT_THAT(complete("i", "--lang"), testing::ElementsAre("it"));
  EXPECT_THAT(complete("part", GetParam()), testing::IsEmpty());  // The shell names files.
  EXPECT_THAT(complete("", "--config"), testing::IsEmpty());
  EXPECT_THAT(complete("--config-", GetParam()), testing::IsEmpty());  // Hidden ones.
}

TEST(IsolintCompletion, KnowsCodesAndFormats) {
  const auto complete = [&](const std::string& word, const std::string& previous) {
    return lines_of(run_command({"isolint", "--complete", "isolint", word, previous}).out);
  };
  EXPECT_THAT(complete("ISO06", "--explain"), testing::SizeIs(9));
  EXPECT_THAT(complete("ISO001,W00", "--ignore"), testing::ElementsAre("ISO001,W001", "ISO001,W002", "ISO001,W003"));
  EXPECT_THAT(complete("js", "--format"), testing::ElementsAre("json"));
  EXPECT_THAT(complete("--fi", "part.iso"), testing::ElementsAre("--fix"));
}

/// As bash calls it.
TEST(IsolintCompletion, ManualPagesSpeakOfEachOption) {
  const std::string page = run_command({"isolint", "--manual-page"}).out;
  EXPECT_THAT(page, StartsWith(".TH ISOLINT 1 "));
  EXPECT_THAT(page, HasSubstr("\\fB\\-\\-unsafe\\-fixes\\fR"));
  EXPECT_THAT(page, testing::Not(HasSubstr("rules\\-page")));
}

}  // namespace
}  // namespace isocnc::commands
