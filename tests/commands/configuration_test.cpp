#include <sys/stat.h>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

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

/// An arc whose end is 0.03 mm off its circle, and a tool that not every machine has.
constexpr std::string_view kArcProgram =
    "M06 T101001\n"
    "S1000 M03\n"
    "G02 X10.03 Y0 I5 J0 F500\n"
    "M05\n"
    "M02\n";

/// A folder with programs and configurations, and commands that are run in it.
class ConfigurationFile : public testing::Test {
 protected:
  CommandResult run(const std::vector<std::string>& command, const std::string& input = {}) const {
    return run_command(command, {.input = input, .folder = folder_.path()});
  }
  /// `FILE:CODE`, or with a severity that is no error `FILE:CODE:SEVERITY`, of what isolint finds.
  std::vector<std::string> found(std::vector<std::string> options, const std::string& input = {}) const {
    options.insert(options.begin(), {"isolint", "--format", "json"});
    const CommandResult result = run(options, input);
    EXPECT_EQ(result.err, "");
    std::vector<std::string> findings;
    for (const json& finding : json::parse(result.out)) {
      std::string text = finding["file"].get<std::string>() + ":" + finding["code"].get<std::string>();
      if (finding["severity"] != "error") text += ":" + finding["severity"].get<std::string>();
      findings.push_back(text);
    }
    return findings;
  }
  void write(const std::string& name, std::string_view text) const { folder_.write(name, text); }

  const support::TemporaryFolder folder_;
};

TEST_F(ConfigurationFile, DescribesTheMachine) {
  write("part.iso", kArcProgram);
  EXPECT_THAT(found({"--select", "ISO", "part.iso"}), ElementsAre("part.iso:ISO031"));
  write("isocnc.json", R"({"machine": {"tolerances": {"arc": 0.05}}})");
  EXPECT_THAT(found({"--select", "ISO", "part.iso"}), IsEmpty());
  write("isocnc.json", R"({"machine": {"tolerances": {"arc": 0.05}, "home": {"x": 1}}})");
  EXPECT_THAT(found({"--select", "ISO", "part.iso"}), ElementsAre("part.iso:ISO031"));
  write("isocnc.json", R"({"machine": {"tolerances": {"arc": 0.05}, "tools": [{"head": 1, "holder": 1, "tool": 2}]}})");
  EXPECT_THAT(found({"--select", "ISO", "part.iso"}), ElementsAre("part.iso:ISO067"));
  write("isocnc.json", R"({"machine": {"tolerances": {"arc": 0.05}, "tools": [{"head": 1, "holder": 1, "tool": 1}]}})");
  EXPECT_THAT(found({"--select", "ISO", "part.iso"}), IsEmpty());
}

TEST_F(ConfigurationFile, IsTheNearestAboveEachProgram) {
  write("isocnc.json", R"({"lint": {"select": ["W001"]}})");
  write("a/isocnc.json", R"({"lint": {"select": ["ISO026"]}})");
  for (const char* name : {"p.iso", "a/p.iso", "a/b/p.iso", "c/p.iso"})
    write(name, "M06 T101001\nG71\nG71\nG01\nM02\n");
  const std::vector<std::string> all = {"a/b/p.iso:ISO026", "a/p.iso:ISO026", "c/p.iso:W001:warning",
                                        "p.iso:W001:warning"};
  EXPECT_EQ(found({}), all);
  EXPECT_EQ(found({"p.iso", "c", "a"}), all);
  EXPECT_THAT(found({"a/../p.iso"}), ElementsAre("a/../p.iso:W001:warning"));
  std::filesystem::create_directory_symlink("a/b", folder_.path("link"));
  EXPECT_THAT(found({"link/p.iso"}), ElementsAre("link/p.iso:ISO026"));
}

TEST_F(ConfigurationFile, OfStandardInputIsThatOfItsName) {
  write("isocnc.json", R"({"lint": {"ignore": ["W001"]}})");
  write("a/isocnc.json", R"({"lint": {"files": [{"paths": ["q.iso"], "severity": {"W001": "info"}}]}})");
  const std::string program(kWarnedProgram);
  EXPECT_THAT(found({"-"}, program), IsEmpty());
  EXPECT_THAT(found({"--stdin-filename", "a/p.iso", "-"}, program), ElementsAre("a/p.iso:W001:warning"));
  EXPECT_THAT(found({"--stdin-filename", "a/q.iso", "-"}, program), ElementsAre("a/q.iso:W001:info"));
  EXPECT_THAT(found({"--stdin-filename", "no/such/folder/p.iso", "-"}, program), IsEmpty());
}

TEST_F(ConfigurationFile, IsOutweighedByTheCommand) {
  write("isocnc.json", R"({"lint": {"ignore": ["ISO"], "severity": {"W001": "info"}}, "language": "it"})");
  write("part.iso", "M06 T101001\nG71\nG71\nG01\nM02\n");
  EXPECT_THAT(found({}), ElementsAre("part.iso:W001:info"));
  EXPECT_THAT(found({"--select", "ISO026"}), ElementsAre("part.iso:ISO026"));
  EXPECT_THAT(found({"--severity", "W001=error"}), ElementsAre("part.iso:W001"));
  EXPECT_THAT(found({"--no-config"}), ElementsAre("part.iso:W001:warning", "part.iso:ISO026"));
  EXPECT_EQ(run({"isolint"}).err, "0 errori, 0 avvisi, 1 nota in 1 file\n");
  EXPECT_EQ(run({"isolint", "--lang", "en"}).err, "0 errors, 0 warnings, 1 note in 1 file\n");
}

TEST_F(ConfigurationFile, MayBeNamed) {
  write("isocnc.json", R"({"lint": {"ignore": ["ALL"]}})");
  write("other/strict.json",
        R"({"lint": {"severity": {"W001": "error"}, "files": [{"paths": ["/p.iso"], "ignore": ["W"]}]}})");
  write("p.iso", kWarnedProgram);
  write("other/p.iso", kWarnedProgram);
  EXPECT_THAT(found({"--config", "other/strict.json", "p.iso", "other/p.iso"}), ElementsAre("p.iso:W001"));
  EXPECT_EQ(run({"isolint", "--config", "other/strict.json", "--no-config"}).status, 2);
  const CommandResult missing = run({"isolint", "--config", "none.json", "p.iso"});
  EXPECT_EQ(missing.status, 2);
  EXPECT_EQ(missing.out, "");
  EXPECT_EQ(missing.err, "none.json: error: cannot read: No such file or directory\n");
}

TEST_F(ConfigurationFile, HasOptionsForSomePrograms) {
  write("isocnc.json", R"({"lint": {"severity": {"W001": "error"}, "files": [
      {"paths": ["old/"], "ignore": ["W001"]},
      {"paths": ["*.keep.iso"], "severity": {"W001": "info"}}]}})");
  for (const char* name : {"p.iso", "old/p.iso", "old/p.keep.iso", "x/p.keep.iso"}) write(name, kWarnedProgram);
  EXPECT_THAT(found({}), ElementsAre("old/p.keep.iso:W001:info", "p.iso:W001", "x/p.keep.iso:W001:info"));
  EXPECT_EQ(run({"isolint", "old/p.iso", "x"}).status, 0);
  EXPECT_EQ(run({"isolint", "old/p.iso", "p.iso"}).err, "1 error, 0 warnings in 2 files\n");
  const json counts = json::parse(run({"isolint", "--statistics", "--format", "json"}).out);
  ASSERT_EQ(counts.size(), 1u);
  EXPECT_EQ(counts[0]["count"], 3);
  EXPECT_EQ(counts[0]["severity"], "error");
}

TEST_F(ConfigurationFile, DoesNotCallWhatItTurnsOffAnUnusedSuppression) {
  write("part.iso", "M06 T101001 ;isolint: ignore W001\nM02\n");
  EXPECT_THAT(found({}), ElementsAre("part.iso:W190:warning"));
  write("isocnc.json", R"({"lint": {"files": [{"paths": ["part.iso"], "ignore": ["W001"]}]}})");
  EXPECT_THAT(found({}), IsEmpty());
}

TEST_F(ConfigurationFile, DistinguishesProgramsFromOtherFiles) {
  write("isocnc.json", R"({"lint": {"extensions": ["mpf", ".ISO"], "exclude": ["scrap/", "*.tmp.iso"]}})");
  write("deep/isocnc.json", R"({"lint": {"extensions": [".nc"]}})");
  for (const char* name : {"a.mpf", "b.iso", "c.nc", "d.tmp.iso", "scrap/e.iso", "deep/f.nc", "deep/g.iso"})
    write(name, kWarnedProgram);
  EXPECT_THAT(found({}), ElementsAre("a.mpf:W001:warning", "b.iso:W001:warning", "deep/f.nc:W001:warning"));
  EXPECT_THAT(found({"scrap"}), ElementsAre("scrap/e.iso:W001:warning"));
  EXPECT_THAT(found({"d.tmp.iso", "c.nc"}), ElementsAre("c.nc:W001:warning", "d.tmp.iso:W001:warning"));
  std::filesystem::create_directory(folder_.path("empty"));
  EXPECT_EQ(run({"isolint", "empty"}).err, "isolint: no programs found (.mpf .ISO)\n");
}

TEST_F(ConfigurationFile, WithMistakesStopsTheCommand) {
  write("isocnc.json", "{\n  \"machine\": {\"maxfeed\": 3},\n  \"format\": {\"decimals\": -1}\n}\n");
  write("deep/isocnc.json", "{");
  write("part.iso", kCleanProgram);
  write("deep/part.iso", kCleanProgram);
  const std::string mistakes =
      "isocnc.json:2:15: error: machine.maxfeed: unknown key; did you mean maxFeed?\n"
      "isocnc.json:3:26: error: format.decimals: -1 is too small: at least 0\n";
  const std::string deep =
      "deep/isocnc.json:1:2: error: the file ends here, but a bracket is still open or a value missing\n";
  const std::vector<std::pair<std::vector<std::string>, std::string>> commands = {
      {{"isolint"}, mistakes + deep},
      {{"isolint", "--format", "json", "part.iso", "deep/part.iso"}, mistakes + deep},
      {{"isolint", "--show-config"}, mistakes},
      {{"isolint", "--config", "isocnc.json", "deep/part.iso"}, mistakes},
      {{"isofmt", "--check", "."}, mistakes + deep},
      {{"isofmt", "-i", "part.iso"}, mistakes},
      {{"isorun", "part.iso"}, mistakes},
      {{"isorun", "--no-config", "--machine", "isocnc.json", "part.iso"}, mistakes}};
  for (const auto& [command, said] : commands) {
    const CommandResult result = run(command);
    EXPECT_EQ(result.status, 2) << testing::PrintToString(command);
    EXPECT_EQ(result.out, "") << testing::PrintToString(command);
    EXPECT_EQ(result.err, said) << testing::PrintToString(command);
  }
  EXPECT_EQ(run({"isolint", "--no-config"}).status, 0);
  EXPECT_THAT(run({"isolint", "--lang", "it", "part.iso"}).err,
              StartsWith("isocnc.json:2:15: errore: machine.maxfeed: chiave sconosciuta; forse maxFeed?\n"));
}

TEST_F(ConfigurationFile, SpeaksItsOwnLanguageOfItsMistakes) {
  write("isocnc.json", R"({"language": "it", "lint": 3})");
  EXPECT_THAT(run({"isolint"}).err, StartsWith("isocnc.json:1:28: errore: lint: "));
}

TEST_F(ConfigurationFile, IsRefusedWhenItIsNoText) {
  write("part.iso", kCleanProgram);
  const auto said = [&](const std::string& text) {
    write("isocnc.json", text);
    const CommandResult result = run({"isolint", "part.iso"});
    EXPECT_EQ(result.status, 2) << text;
    return result.err;
  };
  EXPECT_THAT(said("\xEF\xBB\xBF{}"), StartsWith("isocnc.json:1:1: error: a byte-order mark"));
  EXPECT_THAT(said(std::string("{\0}\0", 4)), StartsWith("isocnc.json:"));
  EXPECT_THAT(said(std::string("\xFF\xFE{\0}\0", 6)), StartsWith("isocnc.json: error: is UTF-16"));
  EXPECT_THAT(said("{\"language\": \"\xE8\"}"), StartsWith("isocnc.json:1:15: error: this is not UTF-8"));
  EXPECT_THAT(said(std::string(200'000, '[')), StartsWith("isocnc.json:1:33: error: nested too deeply"));
  EXPECT_THAT(said("{}" + std::string(2'000'000, ' ')), StartsWith("isocnc.json:1:1: error: larger than"));
}

TEST_F(ConfigurationFile, IsRefusedWhenItIsNoFile) {
  write("part.iso", kCleanProgram);
  const std::string file = folder_.path("isocnc.json");
  std::filesystem::create_directory(file);
  EXPECT_EQ(run({"isolint", "part.iso"}).err, "isocnc.json: error: is a directory\n");
  std::filesystem::remove(file);
  std::filesystem::create_symlink("nowhere", file);
  EXPECT_EQ(run({"isolint", "part.iso"}).err, "isocnc.json: error: cannot read: No such file or directory\n");
  std::filesystem::remove(file);
  ASSERT_EQ(::mkfifo(file.c_str(), 0600), 0);
  const CommandResult pipe = run({"isolint", "part.iso"});
  EXPECT_FALSE(pipe.timed_out);
  EXPECT_EQ(pipe.err, "isocnc.json: error: not a file\n");
  EXPECT_EQ(pipe.status, 2);
}

TEST_F(ConfigurationFile, IsShown) {
  write("a/isocnc.json", R"({"lint": {"ignore": ["W001"]}, "machine": {"maxFeed": 1e4}})");
  const CommandResult shown = run({"isolint", "--show-config", "a/part.iso"});
  EXPECT_EQ(shown.status, 0);
  EXPECT_EQ(shown.err, "isolint: configuration: a/isocnc.json\n");
  const json configuration = json::parse(shown.out);
  EXPECT_EQ(configuration["lint"]["ignore"], json({"W001"}));
  EXPECT_EQ(configuration["machine"]["maxFeed"], 10000);
  EXPECT_EQ(configuration["machine"]["tolerances"]["arc"], 0.01);
  EXPECT_EQ(run({"isolint", "--show-config", "a"}).out, shown.out);
  EXPECT_EQ(run({"isolint", "--config", "a/isocnc.json", "--show-config"}).out, shown.out);
  const CommandResult defaults = run({"isolint", "--no-config", "--show-config", "a"});
  EXPECT_EQ(defaults.err, "isolint: no isocnc.json: these are the defaults\n");
  EXPECT_THAT(defaults.out, Not(HasSubstr("maxFeed")));
  EXPECT_EQ(run({"isolint", "--show-config", "a", "."}).status, 2);
}

TEST_F(ConfigurationFile, SetsTheStyleOfIsofmt) {
  write("isocnc.json", R"({"format": {"decimals": 3, "gDigits": 2, "modal": "write", "wordOrder": true,
                                       "renumber": {"start": 5, "step": 5}}})");
  write("part.iso", "N1 g1 Y2.50 X1 F100\nN2 X3.0\nN3 M02\n");
  const auto formatted = [&](std::vector<std::string> options) {
    options.insert(options.begin(), "isofmt");
    options.emplace_back("part.iso");
    const CommandResult result = run(options);
    EXPECT_EQ(result.status, 0) << result.err;
    return result.out;
  };
  EXPECT_EQ(formatted({}), "N5 G01 X1 Y2.5 F100\nN10 G01 X3\nN15 M02\n");
  EXPECT_EQ(formatted({"--renumber", "10:10", "--modal", "keep", "--decimals", "keep", "--g-digits", "1"}),
            "N10 G1 X1 Y2.50 F100\nN20 X3.0\nN30 M02\n");
  EXPECT_EQ(formatted({"--renumber", "keep", "--no-word-order", "--decimals", "1", "--g-digits", "keep"}),
            "N1 G1 Y2.5 X1 F100\nN2 G01 X3\nN3 M02\n");
  EXPECT_EQ(formatted({"--no-config"}), "N1 G1 Y2.50 X1 F100\nN2 X3.0\nN3 M02\n");
  EXPECT_EQ(run({"isofmt", "--stdin-filename", "x.iso", "-"}, "g0 x1\n").out, "G00 X1\n");
}

TEST_F(ConfigurationFile, SetsTheMachineOfIsorun) {
  const std::string program = "M06 T101001\nG91 G00 X10\nM02\n";
  write("part.iso", program);
  const auto ran = [&](std::vector<std::string> options) {
    options.insert(options.begin(), "isorun");
    return run(options);
  };
  write("isocnc.json", R"({"machine": {"home": {"x": 100}}})");
  EXPECT_THAT(ran({"part.iso"}).out, HasSubstr("X110.000"));
  EXPECT_THAT(ran({"--no-config", "part.iso"}).out, HasSubstr("X10.000"));
  EXPECT_THAT(run({"isorun", "-"}, program).out, HasSubstr("X110.000"));
  write("m/small.json", R"({"machine": {"home": {"x": 200}}, "language": "it"})");
  EXPECT_THAT(ran({"--config", "m/small.json", "part.iso"}).out, HasSubstr("esito: "));
  const CommandResult other = ran({"--machine", "m/small.json", "part.iso"});
  EXPECT_THAT(other.out, HasSubstr("X210.000"));
  EXPECT_THAT(other.out, StartsWith("result: "));  // Of that file the machine alone is taken.
  write("m/none.json", R"({"machine": {"tools": []}})");
  const CommandResult refused = ran({"--machine", "m/none.json", "part.iso"});
  EXPECT_EQ(refused.status, 1);
  EXPECT_THAT(refused.err, HasSubstr("[ISO067]"));
}

TEST(ConfigurationExample, IsCleanAndKnowsItsTools) {
  const std::string folder = ISOCNC_SOURCE_DIR "/examples/machine";
  EXPECT_EQ(run_command({"isolint", "--format", "concise", folder}).out, "");
  EXPECT_EQ(run_command({"isofmt", "--check", folder}).status, 0);
  EXPECT_EQ(run_command({"isorun", folder + "/shelf.iso"}).status, 0);
  std::stringstream text;
  text << std::ifstream(folder + "/shelf.iso").rdbuf();
  std::string program = text.str();
  program.replace(program.find("T102005"), 7, "T102006");
  const CommandResult result = run_command(
      {"isolint", "--format", "concise", "--stdin-filename", folder + "/other.iso", "-"}, {.input = program});
  EXPECT_THAT(result.out, HasSubstr("[ISO067]"));
}

}  // namespace
}  // namespace isocnc::commands
