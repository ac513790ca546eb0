#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "programs.h"
#include "run_command.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text_of_file.h"

namespace isocnc::commands {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;
using json = nlohmann::json;

const std::string kOld =
    "M06 T101001\n"
    "S12000 M03\n"
    "G00 X10 Y20 Z40\n"
    "G01 Z-5 F2000\n"
    "X100\n"
    "Y80\n"
    "M02\n";
const std::string kNew =
    "M06 T101001\n"
    "S9000 M03\n"
    "G00 X10 Y20 Z40\n"
    "G01 Z-5 F2000\n"
    "X101\n"
    "Y80\n"
    "M02\n";

/// A program with a path of its own for each of the first values of VGPL.
std::string branches(int count) {
  std::string program = "M06 T101001\n";
  for (int i = 1; i <= count; ++i) {
    const std::string number = std::to_string(i);
    program += "IF VGPL = " + number + " GOTO N" + number + "\nG00 X" + std::to_string(5 * i) + "\nN" + number + '\n';
  }
  return program + "M02\n";
}

/// Two programs in a folder.
class IsodiffCommand : public testing::Test {
 protected:
  IsodiffCommand() {
    folder_.write("old.iso", kOld);
    folder_.write("new.iso", kNew);
  }

  CommandResult diff(std::vector<std::string> options, const std::string& input = "") const {
    options.insert(options.begin(), "isodiff");
    return run_command(options, {.input = input, .folder = folder_.path()});
  }

  support::TemporaryFolder folder_;
};

TEST_F(IsodiffCommand, SaysThatNothingDiffers) {
  const CommandResult result = diff({"old.iso", "old.iso"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.out, "no difference\n");
  EXPECT_EQ(result.err, "");
}

TEST_F(IsodiffCommand, ListsChangesByTool) {
  const CommandResult result = diff({"old.iso", "new.iso"});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.out,
            "T101001\n"
            "  line 2: S9000 M03 instead of S12000 M03\n"
            "  lines 5-6: moved by X1\n"
            "feed moves: 196 mm, were 195 mm\n"
            "extent in X: 0 to 101, was 0 to 100 (machine)\n"
            "2 differences\n");
  EXPECT_THAT(diff({"--lang", "it", "old.iso", "new.iso"}).out, StartsWith("T101001\n"
                                                                           "  riga 2: S9000 M03 invece di S12000 M03\n"
                                                                           "  righe 5-6: spostato di X1\n"));
}

TEST_F(IsodiffCommand, WritesJson) {
  const CommandResult result = diff({"--format", "json", "old.iso", "new.iso"});
  EXPECT_EQ(result.status, 1);
  json both = json::parse(result.out);
  EXPECT_EQ(both.at("same"), false);
  const auto time = [&](const char* run) { return both.at(run).at("time").get<double>(); };
  EXPECT_EQ(both["changes"][0]["seconds"], 0.0);
  EXPECT_NEAR(both["changes"][1]["seconds"].get<double>(), time("new") - time("old"), 0.001);
  for (json& change : both["changes"]) change.erase("seconds");
  EXPECT_NEAR(both.at("old").at("time").get<double>(),
              json::parse(run_command({"isorun", "--json", folder_.path("old.iso")}).out).at("seconds"), 1e-9);
  EXPECT_EQ(both.at("changes"), json::parse(R"([
      {"kind": "speed", "old": [2, 2], "new": [2, 2], "tool": "T101001", "distance": null,
       "text": "S9000 M03 instead of S12000 M03"},
      {"kind": "moved", "old": [5, 6], "new": [5, 6], "tool": "T101001", "distance": 1.0, "text": "moved by X1"}])"));
  EXPECT_EQ(json::parse(diff({"--format", "json", "old.iso", "old.iso"}).out).at("changes"), json::array());
}

/// The text of a block of data in a page.
std::string block_of(const std::string& page, const std::string& name) {
  const std::size_t begin = page.find('>', page.find("<script id=\"data-" + name + "\"")) + 1;
  return page.substr(begin, page.find("</script>", begin) - begin);
}

TEST_F(IsodiffCommand, WritesAPageWithBothPrograms) {
  const CommandResult result = diff({"--format", "html", "--output", "page.html", "old.iso", "new.iso"});
  if (result.err.find("npm") != std::string::npos) GTEST_SKIP() << "this isodiff writes no page";
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.status, 1);
  const std::string page = text_of_file(folder_.path("page.html"));
  EXPECT_TRUE(page.find("<title>old.iso → new.iso</title>") != std::string::npos);
  json expected = json::parse(diff({"--format", "json", "old.iso", "new.iso"}).out);
  const json italian = json::parse(diff({"--format", "json", "--lang", "it", "old.iso", "new.iso"}).out);
  for (std::size_t i = 0; i < expected["changes"].size(); ++i)
    expected["changes"][i]["text"] = {{"en", expected["changes"][i]["text"]}, {"it", italian["changes"][i]["text"]}};
  EXPECT_EQ(json::parse(block_of(page, "comparison")), expected);
  EXPECT_EQ(json::parse(block_of(page, "old-facts")).at("name"), "old.iso");
  EXPECT_EQ(json::parse(block_of(page, "facts")).at("name"), "new.iso");
  EXPECT_EQ(block_of(page, "alignment"), "AQEH");  // Seven lines beside seven.
  EXPECT_NE(block_of(page, "old-points"), block_of(page, "points"));
  for (const char* const name : {"steps", "turns", "program", "old-steps", "old-program"})
    EXPECT_TRUE(page.find("<script id=\"data-" + std::string(name) + "\"") != std::string::npos) << name;
  // The path is the one of isorun's page.
  run_command({"isorun", "--no-config", "--plot", folder_.path("plot.html"), folder_.path("new.iso")});
  EXPECT_EQ(block_of(page, "points"), block_of(text_of_file(folder_.path("plot.html")), "points"));
}

TEST_F(IsodiffCommand, WritesNoPageToATerminal) {
  const std::string log = folder_.path("log");
  const std::string command =
      "cd " + folder_.path() + " && python3 -c \"import os, pty, sys; sys.exit(os.waitstatus_to_exitcode(pty.spawn(['" +
      ISOCNC_BIN_DIR "/isodiff', '--format', 'html', 'old.iso', 'new.iso'])))\" </dev/null >" + log + " 2>&1";
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 2);
  EXPECT_THAT(text_of_file(log), testing::AnyOf(HasSubstr("--output"), HasSubstr("npm")));
}

TEST_F(IsodiffCommand, WritesNoPageOverAProgram) {
  EXPECT_EQ(diff({"--format", "html", "--output", "new.iso", "old.iso", "new.iso"}).status, 2);
  EXPECT_EQ(text_of_file(folder_.path("new.iso")), kNew);
  EXPECT_THAT(diff({"--format", "html", "--verify", "--output", "page.html", "old.iso", "new.iso"}).err,
              testing::AnyOf(HasSubstr("shows no contacts and no material"), HasSubstr("npm")));
  EXPECT_THAT(diff({"--format", "html", "--all-paths", "--output", "page.html", "old.iso", "new.iso"}).err,
              testing::AnyOf(HasSubstr("--vgpl"), HasSubstr("npm")));
  // Nothing is left of a page where a program cannot be read.
  EXPECT_EQ(diff({"--format", "html", "--output", "page.html", "old.iso", "none.iso"}).status, 2);
  EXPECT_FALSE(std::filesystem::exists(folder_.path("page.html")));
  EXPECT_EQ(diff({"--format", "html", "--output", "none/page.html", "old.iso", "new.iso"}).status, 2);
}

TEST_F(IsodiffCommand, ItsJsonFitsItsSchema) {
  folder_.write("error.iso", kOld.substr(0, kOld.size() - 4) + "G01\n");
  folder_.write("added.iso", "G00 X10\n" + kOld);
  folder_.write("branches.iso", branches(12));
  folder_.write("register.iso", "M06 T101001\nIF V3 = 1 GOTO N5\nG00 X10\nN5 G00 X20 Y5\nM02\n");
  json documents;
  for (const char* const other : {"old.iso", "new.iso", "error.iso", "added.iso", "register.iso"}) {
    json both = json::parse(diff({"--format", "json", "old.iso", other}).out);
    documents.push_back({{"document", both}, {"valid", true}});
    both["changes"].push_back({{"kind", "other"}});
    documents.push_back({{"document", both}, {"valid", false}});
  }
  for (std::vector<std::string> options : {std::vector<std::string>{"--all-paths", "branches.iso", "old.iso"},
                                           {"--all-paths", "register.iso", "old.iso"},
                                           {"--verify", ISOCNC_SOURCE_DIR "/examples/setups/panel.iso",
                                            ISOCNC_SOURCE_DIR "/examples/setups/broken/panel.iso"}}) {
    options.insert(options.begin(), {"--format", "json"});
    json both = json::parse(diff(options).out);
    documents.push_back({{"document", both}, {"valid", true}});
    both["old"]["extents"]["X"].push_back(1);
    documents.push_back({{"document", both}, {"valid", false}});
  }
  const json schema = json::parse(text_of_file(ISOCNC_SOURCE_DIR "/docs/isodiff.schema.json"));
  const std::string task = folder_.write("task.json", json{{"schema", schema}, {"documents", documents}}.dump());
  const std::string log = folder_.path("log");
  const std::string command = "python3 " ISOCNC_SOURCE_DIR "/tests/support/validate.py " + task + " >" + log + " 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(text_of_file(log), "16 documents\n");
}

/// Each way to write the examples makes the machine do the same.
TEST_F(IsodiffCommand, FormattingMakesNoDifference) {
  const std::vector<std::vector<std::string>> styles = {
      {}, {"--modal", "write", "--g-digits", "2"}, {"--modal", "fold", "--decimals", "4", "--renumber", "10:10"}};
  std::size_t programs = 0;
  for (const auto& entry : std::filesystem::directory_iterator(ISOCNC_SOURCE_DIR "/examples")) {
    if (entry.path().extension() != ".iso") continue;
    ++programs;
    for (std::vector<std::string> style : styles) {
      style.insert(style.begin(), {"isofmt", "--no-config", "--stdout", entry.path().string()});
      const std::string formatted = run_command(style).out;
      EXPECT_FALSE(formatted.empty());
      const CommandResult result = diff({"--no-config", entry.path().string(), "-"}, formatted);
      EXPECT_THAT(result.out, testing::EndsWith("no difference\n")) << entry.path();
    }
  }
  EXPECT_GT(programs, 10U);
}

/// What is ignored hides no path: the machine would go around the other side.
TEST_F(IsodiffCommand, NamesAPathBesideWhatIsIgnored) {
  const std::string start = "M06 T101001\nS9000 M03\nG00 X10 Y10 Z2\nG01 Z-2 F1000\n";
  folder_.write("a.iso", start + "G04 P1\nG03 X50 Y10 I30 J10\nG01 X90\nM02\n");
  folder_.write("b.iso", start + "G04 P2\nG02 X50 Y10 I30 J10\nG01 X90\nM02\n");
  const CommandResult result = diff({"--ignore", "time", "--format", "json", "a.iso", "b.iso"});
  EXPECT_EQ(result.status, 1);
  const json changes = json::parse(result.out).at("changes");
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes[0].at("kind"), "shape");
  EXPECT_EQ(changes[0].at("old"), json::parse("[6, 6]"));
  EXPECT_NEAR(changes[0].at("distance").get<double>(), 20 * std::sqrt(2), 0.001);
}

TEST_F(IsodiffCommand, SaysHowMuchEarlierAFunctionComes) {
  const std::string start = "M06 T101001\nS9000 M03\nG00 X10 Y10 Z2\nG01 Z-2 F1000\n";
  folder_.write("a.iso", start + "X60\nM08\nY50\nG04 P1\nX0\nM02\n");
  folder_.write("b.iso", start + "X40\nM08\nX60\nY50\nX20\nG04 P1\nX0\nM02\n");
  EXPECT_EQ(diff({"a.iso", "b.iso"}).out,
            "T101001\n"
            "  line 6: M08 comes 20 mm earlier\n"
            "  old line 8, new line 10: dwell of 1 s comes 40 mm later\n"
            "2 differences\n");
  EXPECT_THAT(diff({"--lang", "it", "a.iso", "b.iso"}).out, HasSubstr("M08 viene 20 mm prima\n"));
  EXPECT_THAT(diff({"--lang", "it", "a.iso", "b.iso"}).out, HasSubstr("attesa di 1 s viene 40 mm dopo\n"));
  EXPECT_EQ(json::parse(diff({"--format", "json", "a.iso", "b.iso"}).out).at("changes").at(0).at("distance"), 20.0);
}

TEST_F(IsodiffCommand, ReadsStandardInput) {
  EXPECT_EQ(diff({"-", "old.iso"}, kOld).out, "no difference\n");
  EXPECT_EQ(diff({"old.iso", "/dev/stdin"}, kNew).status, 1);
  const CommandResult result = diff({"-", "-"}, kOld);
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.err, "isodiff: only one of the programs can come from standard input\n");
}

TEST_F(IsodiffCommand, WritesAFile) {
  const CommandResult result = diff({"-o", "result", "old.iso", "new.iso"});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(text_of_file(folder_.path("result")), StartsWith("T101001\n"));
}

TEST_F(IsodiffCommand, OverwritesNoneOfThePrograms) {
  const CommandResult result = diff({"-o", "new.iso", "old.iso", "new.iso"});
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.err, "isodiff: new.iso: this would overwrite new.iso\n");
}

TEST_F(IsodiffCommand, IgnoresWhatIsAskedFor) {
  EXPECT_THAT(diff({"--ignore", "speed,feed", "old.iso", "new.iso"}).out, EndsWith("1 difference\n"));
  EXPECT_EQ(diff({"--ignore", "speed", "--ignore=time,comments", "--tolerance", "1.5", "old.iso", "new.iso"}).out,
            "no difference\n");
}

TEST_F(IsodiffCommand, RunsBothUnderTheSameValues) {
  folder_.write("a.iso", "M06 T101001\nIF VGPL = 1 GOTO N5\nG00 X10\nN5 G00 X20 Y5\nM02\n");
  folder_.write("b.iso", "M06 T101001\nIF V3 = 1 GOTO N5\nG00 X10\nN5 G00 X20 Y5\nM02\n");
  EXPECT_EQ(diff({"a.iso", "b.iso"}).status, 0);
  EXPECT_EQ(diff({"--vgpl", "1", "--set", "V3=1", "a.iso", "b.iso"}).status, 0);
  EXPECT_THAT(diff({"--set", "V3=1", "a.iso", "b.iso"}).out,
              HasSubstr("the IF of line 2 jumps in the new program only"));
}

TEST_F(IsodiffCommand, EachProgramHasTheMachineAboveIt) {
  folder_.write("isocnc.json", R"({"machine": {"home": {"z": 100}}})");
  folder_.write("other/isocnc.json", R"({"machine": {"home": {"z": 150}}})");
  folder_.write("other/old.iso", kOld);
  const CommandResult other = diff({"old.iso", "other/old.iso"});
  EXPECT_EQ(other.status, 1);
  EXPECT_EQ(other.err,
            "isodiff: the programs have different configurations, isocnc.json and other/isocnc.json; --config "
            "takes one for both\n");
  EXPECT_EQ(diff({"old.iso", "old.iso"}).err, "");
  EXPECT_EQ(diff({"--no-config", "old.iso", "other/old.iso"}).status, 0);
  EXPECT_EQ(diff({"--config", "isocnc.json", "old.iso", "other/old.iso"}).status, 0);
  EXPECT_EQ(diff({"--machine", "isocnc.json", "old.iso", "other/old.iso"}).status, 0);
}

TEST_F(IsodiffCommand, TellsLikeChangesInOneLine) {
  const auto holes = [](int count, int depth) {
    std::string program = "M06 T101001\nG00 X0 Y0 Z20\n";
    for (int i = 0; i < count; ++i) program += fmt::format("G00 X{} Y5\nZ2\nG01 Z-{} F500\nG00 Z5\n", 10 * i, depth);
    return program + "G00 Z50\nM02\n";
  };
  for (const int count : {3, 4}) {
    folder_.write("old.iso", holes(count, 10));
    folder_.write("new.iso", holes(count, 12));
    const std::string text = diff({"old.iso", "new.iso"}).out;
    EXPECT_EQ(text.find("lines 5-17, in 4 places: moved by Z-2\n") != std::string::npos, count == 4) << text;
    EXPECT_EQ(text.find("line 5: moved by Z-2\n  line 9: moved by Z-2\n") != std::string::npos, count == 3) << text;
    EXPECT_THAT(text, HasSubstr(fmt::format("\n{} differences\n", count)));
  }
}

TEST_F(IsodiffCommand, SaysWhereBothStop) {
  folder_.write("a.iso", kBrokenProgram);
  folder_.write("b.iso", std::string("( the same )\n").append(kBrokenProgram));
  const CommandResult result = diff({"a.iso", "b.iso"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.out, "no difference\nboth stop at an error: ISO026 on line 3, ISO026 on line 4\n");
}

TEST_F(IsodiffCommand, NamesFindingsThatAreNewOrGone) {
  folder_.write("isocnc.json", R"({"machine": {"axes": {"X": {"min": 0, "max": 100.5}}}})");
  const CommandResult result = diff({"old.iso", "new.iso"});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.out, HasSubstr("findings\n"
                                    "  new: line 5: error[E160]: the machine's X leaves its travel: it goes to 101, "
                                    "and the travel ends at 100.5\n"
                                    "2 differences\n"));
  EXPECT_THAT(diff({"--lang", "it", "new.iso", "old.iso"}).out, HasSubstr("segnalazioni\n"
                                                                          "  non più: prima riga 5: errore[E160]: "));
  folder_.write("isocnc.json",
                R"({"machine": {"axes": {"X": {"min": 0, "max": 100.5}}}, "lint": {"ignore": ["E160"]}})");
  EXPECT_THAT(diff({"old.iso", "new.iso"}).out, testing::Not(HasSubstr("findings")));
}

/// A finding that differs alone makes no difference.
TEST_F(IsodiffCommand, AnswersByItsStatusWhatTheMachineDoes) {
  folder_.write("isocnc.json", R"({"machine": {"axes": {"X": {"min": 0, "max": 50}}}})");
  folder_.write("comment.iso", ";isolint: disable E160\n" + kOld);
  const CommandResult result = diff({"old.iso", "comment.iso"});
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.out, StartsWith("no difference\nfindings\n  gone: old line 5: error[E160]: "));
}

TEST_F(IsodiffCommand, ComparesContactsAndRemovedVolume) {
  const std::string setups = ISOCNC_SOURCE_DIR "/examples/setups/";
  EXPECT_THAT(diff({setups + "panel.iso", setups + "broken/panel.iso"}).out, testing::Not(HasSubstr("E152")));
  const CommandResult verified = diff({"--verify", setups + "panel.iso", setups + "broken/panel.iso"});
  EXPECT_EQ(verified.status, 1);
  EXPECT_THAT(verified.out, HasSubstr("removed volume: "));
  EXPECT_THAT(verified.out, HasSubstr("  new: line 11: error[E152]: the cutter of T101001 hits cup 2: 1 mm deep"));
  const json both =
      json::parse(diff({"--verify", "--format", "json", setups + "panel.iso", setups + "broken/panel.iso"}).out);
  const json alone = json::parse(
      run_command({"isorun", "--verify", "--json", setups + "broken/panel.iso"}, {.folder = folder_.path()}).out);
  EXPECT_NEAR(both.at("new").at("removedVolume"), alone.at("verification").at("removedVolume").get<double>(), 1e-6);
  EXPECT_EQ(both.at("new").at("feedMm"),
            alone.at("feeds").at("lengthMm").get<double>() + alone.at("arcs").at("lengthMm").get<double>());
  EXPECT_NEAR(both.at("new").at("tools")[0].at("time"), alone.at("tools")[0].at("seconds").get<double>(), 1e-6);
  EXPECT_EQ(both.at("new").at("extents").at("X"), alone.at("extents").at("X"));
  std::size_t contacts = 0;
  for (const json& each : both.at("findings")) contacts += each.at("code") == "E152" ? 1 : 0;
  EXPECT_EQ(contacts, alone.at("verification").at("contacts").size());
  EXPECT_EQ(diff({"--verify", setups + "panel.iso", setups + "panel.iso"}).out, "no difference\n");
  const CommandResult without = diff({"--verify", setups + "panel.iso", "old.iso"});
  EXPECT_EQ(without.status, 1);
  EXPECT_THAT(without.err,
              HasSubstr("isodiff: old.iso: no setup is for this program, so contacts and material are not compared\n"));
  // The machine has bodies, which are no setup.
  folder_.write(
      "isocnc.json",
      R"({"machine": {"bodies": [{"name": "table", "on": "machine", "box": [[-100, -100, -90], [500, 300, -80]]}]}})");
  folder_.write("panel.iso", text_of_file(setups + "broken/panel.iso"));
  const CommandResult gone = diff({"--verify", setups + "broken/panel.iso", "panel.iso"});
  EXPECT_THAT(gone.err, HasSubstr("panel.iso: no setup is for this program"));
  EXPECT_THAT(gone.out, testing::Not(HasSubstr("hits cup")));
}

TEST_F(IsodiffCommand, ComparesOnAllPaths) {
  folder_.write("a.iso", "M06 T101001\nIF VGPL = 1 GOTO N5\nG00 X10\nN5 G00 X20 Y5\nM02\n");
  folder_.write("b.iso", "M06 T101001\nIF VGPL = 1 GOTO N5\nG00 X10 Y1\nN5 G00 X20 Y5\nM02\n");
  EXPECT_EQ(diff({"--vgpl", "1", "a.iso", "b.iso"}).status, 0);
  const CommandResult result = diff({"--vgpl", "1", "--all-paths", "a.iso", "b.iso"});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.out, StartsWith("VGPL = 1: no difference\n"
                                     "VGPL <> 1:\n"
                                     "  T101001\n"
                                     "    line 3: moved by Y1\n"));
  EXPECT_EQ(diff({"a.iso", "a.iso"}).out,
            "not compared: other values of VGPL at the jump of line 2 (--all-paths)\nno difference\n");
  EXPECT_EQ(diff({"--all-paths", "a.iso", "a.iso"}).out, "all 2 combinations of paths: no difference\n");
  EXPECT_EQ(diff({"--all-paths", "old.iso", "old.iso"}).out, "any VGPL: no difference\n");
  const json both = json::parse(diff({"--vgpl", "1", "--all-paths", "--format", "json", "a.iso", "b.iso"}).out);
  EXPECT_EQ(both.at("same"), false);
  EXPECT_EQ(both.at("changes").size(), 1U) << "those of all paths";
  EXPECT_EQ(both.at("paths")[0].at("same"), true);
  EXPECT_EQ(both.at("paths")[1].at("values"), "VGPL <> 1");
  EXPECT_EQ(both.at("notCompared"), nullptr);
}

/// An S alone waits for the next M03 or M04, and the custom software may read it before.
TEST_F(IsodiffCommand, NamesASpeedThatWaits) {
  const std::string base = "M06 T101001\nS9000 M03\nG01 X10 F1000\nS8000\nX20\nM05\nM02\n";
  folder_.write("a.iso", base);
  folder_.write("b.iso", std::string(base).replace(base.find("S8000"), 5, "S7000"));
  folder_.write("c.iso", std::string(base).replace(base.find("S8000\n"), 6, ""));
  EXPECT_EQ(diff({"a.iso", "b.iso"}).out, "T101001\n  line 4: S7000 instead of S8000\n1 difference\n");
  EXPECT_EQ(diff({"--ignore", "speed", "a.iso", "b.iso"}).status, 0);
  EXPECT_THAT(diff({"a.iso", "c.iso"}).out, HasSubstr("removed: S8000\n1 difference\n"));
  // Set before it is used, and used at once, is the same.
  folder_.write("d.iso", "M06 T101001\nS9000\nM03\nG01 X10 F1000\nM05\nM02\n");
  folder_.write("e.iso", "M06 T101001\nS9000 M03\nG01 X10 F1000\nS9000\nM05\nM02\n");
  EXPECT_EQ(diff({"d.iso", "e.iso"}).status, 0);
}

TEST_F(IsodiffCommand, FindingsQuoteTheirOwnLines) {
  folder_.write("isocnc.json", R"({"machine": {"maxSpindleSpeed": 18000}})");
  const std::string base = "M06 T101001\nS19000 M03\nG00 X10\nS20000 M03\nG00 X20\nS24000 M03\nG00 X30\nM02\n";
  folder_.write("a.iso", base);
  folder_.write("b.iso", std::string(base).replace(base.find("S24000"), 6, "S17000"));
  folder_.write("c.iso",
                std::string(base).replace(base.find("S19000"), 6, "S19500").replace(base.find("S24000"), 6, "S25000"));
  EXPECT_THAT(diff({"a.iso", "b.iso"}).out,
              HasSubstr("gone: old line 6: warning[W133]: S24000 is more than the machine's 18000 rev/min\n"));
  const std::string changed = diff({"a.iso", "c.iso"}).out;
  EXPECT_THAT(changed, HasSubstr("changed: line 2: warning[W133]: S19500 is more than the machine's 18000 rev/min\n"
                                 "    was: S19000 is more than the machine's 18000 rev/min\n"));
  EXPECT_THAT(changed, HasSubstr("changed: line 6: warning[W133]: S25000 is more"));
  EXPECT_THAT(changed, testing::Not(HasSubstr("line 4")));
}

/// The same depth in millimeters and in inches is the same.
TEST_F(IsodiffCommand, FindingsHaveNoUnit) {
  folder_.write("isocnc.json", R"({
    "machine": {"kinematics": {"type": "head", "pivot": 180}, "home": {"z": 100}, "axes": {"X": {"min": -10, "max": 300}},
      "tools": [{"head": 1, "holder": 1, "tool": 1, "length": 80, "radius": 5, "shape": "flat", "cutLength": 30}]},
    "setups": [{"paths": ["*.iso"], "fixtures": [{"name": "clamp", "box": [[50, -20, -5], [70, 20, 13]]}]}]})");
  folder_.write("mm.iso", "M06 T101001\nG71\nG00 X0 Y0 Z10\nG01 X254 F2540\nG01 X254 Y25.4\nX508\nM02\n");
  folder_.write("inch.iso", "M06 T101001\nG70\nG00 X0 Y0 Z0.3937007874\nG01 X10 F100\nG01 X10 Y1\nX20\nM02\n");
  const CommandResult result = diff({"--verify", "mm.iso", "inch.iso"});
  EXPECT_EQ(result.out, "no difference\n");
  EXPECT_EQ(result.err, "");
}

TEST_F(IsodiffCommand, SaysAsDataWhatItHasNotCompared) {
  folder_.write("a.iso", "M06 T101001\nIF VGPL = 1 GOTO N5\nG00 X10\nN5 G00 X20 Y5\nM02\n");
  const auto others = [&](const std::string& old_program, const std::string& new_program) {
    const json compared = json::parse(diff({"--format", "json", old_program, new_program}).out);
    return compared.value("otherPaths", json());
  };
  EXPECT_EQ(others("a.iso", "a.iso"), json::parse(R"([{"revision": "new", "name": "VGPL", "line": 2}])"));
  EXPECT_EQ(others("a.iso", "old.iso"), json::parse(R"([{"revision": "old", "name": "VGPL", "line": 2}])"));
  EXPECT_EQ(others("old.iso", "new.iso"), json());
}

/// What has not been compared may differ.
TEST_F(IsodiffCommand, AdmitsWhatItHasNotCompared) {
  folder_.write("a.iso", branches(12));
  const CommandResult result = diff({"--all-paths", "a.iso", "a.iso"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.out, HasSubstr("no difference\nnot compared: VGPL = 8, VGPL = 9, "));
  EXPECT_EQ(diff({"--all-paths", "a.iso", "old.iso"}).status, 1);
  folder_.write("v.iso", "M06 T101001\nIF V3 = 1 GOTO N5\nG00 X10\nN5 G00 X20 Y5\nM02\n");
  const CommandResult registers = diff({"--all-paths", "v.iso", "v.iso"});
  EXPECT_EQ(registers.status, 2);
  EXPECT_THAT(registers.out, HasSubstr("not compared: other values of V3, "));
  EXPECT_EQ(diff({"--all-paths", "--set", "V3=1", "v.iso", "v.iso"}).status, 0);
}

TEST_F(IsodiffCommand, HasAHeadingForEachOperation) {
  const std::string again = "M06 T101001\nG00 X10\nM06 T101002\nG00 X20\nM06 T101001\nG00 X30\nM02\n";
  folder_.write("a.iso", again);
  folder_.write("b.iso", std::string(again).replace(again.find("X30"), 3, "X31"));
  EXPECT_THAT(diff({"a.iso", "b.iso"}).out, StartsWith("T101001, operation 3\n"));
  EXPECT_THAT(diff({"--lang", "it", "a.iso", "b.iso"}).out, StartsWith("T101001, lavorazione 3\n"));
}

TEST_F(IsodiffCommand, HasColorsWhereTheyAreWanted) {
  EXPECT_THAT(diff({"old.iso", "new.iso"}).out, testing::Not(HasSubstr("\x1b")));
  EXPECT_THAT(diff({"--color", "always", "old.iso", "new.iso"}).out,
              StartsWith("\x1b[1mT101001\x1b[0m\n  line 2: \x1b[33mS9000 M03 instead of S12000 M03\x1b[0m\n"));
  EXPECT_EQ(diff({"--color", "sometimes", "old.iso", "new.iso"}).status, 2);
}

TEST_F(IsodiffCommand, RefusesMistakes) {
  const auto refusal = [&](std::vector<std::string> options) {
    options.insert(options.end(), {"old.iso", "new.iso"});
    const CommandResult result = diff(options);
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(result.out, "");
    return result.err;
  };
  EXPECT_EQ(refusal({"--tolerance", "0"}),
            "isodiff: --tolerance takes a plain number of mm above 0, such as 0.001, not 0\n");
  EXPECT_EQ(refusal({"--ignore", "feed,color"}), "isodiff: --ignore takes feed, speed, time or comments, not color\n");
  EXPECT_EQ(refusal({"--vgpl", "x"}), "isodiff: --vgpl takes a plain number, such as -2.5, not x\n");
  EXPECT_EQ(refusal({"--set", "V31=1"}),
            "isodiff: --set takes a register and a plain number, V1=0 to V30=-2.5, not V31=1\n");
  EXPECT_THAT(refusal({"--format", "pdf"}), HasSubstr("pdf"));
  const CommandResult result = diff({"old.iso", "none.iso"});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, StartsWith("isodiff: none.iso: "));
}

}  // namespace
}  // namespace isocnc::commands
