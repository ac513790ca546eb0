#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "programs.h"
#include "run_command.h"
#include "tests/support/temporary_folder.h"

namespace isocnc::commands {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

constexpr std::string_view kCutting =
    "M06 T101001\n"
    "S12000 M03\n"
    "G00 X10 Y20 Z40\n"
    "Z3\n"
    "G01 Z-5 F2000\n"
    "X100\n"
    "G41\n"
    "X150 Y40\n"
    "G40\n"
    "G00 Z40\n"
    "M02\n";

constexpr std::string_view kRestarted =
    "; restart of <stdin> before its line 6\n"
    "M06 T101001\n"
    "S12000 M03\n"
    "; approach\n"
    "G00 Z40\n"
    "X10 Y20\n"
    "Z3\n"
    "G01 Z-5 F1000\n"
    "F2000\n"
    "; the program from line 6 on\n"
    "X100\n"
    "G41\n"
    "X150 Y40\n"
    "G40\n"
    "G00 Z40\n"
    "M02\n";

CommandResult restart(std::vector<std::string> options, std::string_view program = kCutting) {
  options.insert(options.begin(), {"isorun", "-"});
  return run_command(options, {.input = std::string(program)});
}

std::string content_of(const std::string& path) {
  std::stringstream content;
  content << std::ifstream(path, std::ios::binary).rdbuf();
  return content.str();
}

TEST(IsorunRestart, WritesTheProgramToStandardOutput) {
  const CommandResult result = restart({"--restart-at", "6"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.out, kRestarted);
  EXPECT_EQ(result.err, "");
  EXPECT_EQ(restart({"--restart-at", "6", "-o", "-"}).out, kRestarted);
}

TEST(IsorunRestart, WritesTheProgramToAFile) {
  const support::TemporaryFolder folder;
  const std::string output = folder.write("again.iso", "what stood there before");
  const CommandResult result = restart({"--restart-at", "6", "-o", output});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(content_of(output), kRestarted);
}

TEST(IsorunRestart, NamesTheProgram) {
  const support::TemporaryFolder folder;
  const std::string file = folder.write("part.iso", kCutting);
  EXPECT_THAT(run_command({"isorun", "--restart-at", "6", file}).out,
              StartsWith("; restart of part.iso before its line 6\n"));
  EXPECT_THAT(run_command({"isorun", "--lang", "it", "--restart-at", "6", file}).out,
              StartsWith("; ripresa di part.iso dalla riga 6\n"));
}

TEST(IsorunRestart, KeepsMarkAndLineEnds) {
  std::string windows = "\xEF\xBB\xBF";
  std::string expected = windows;
  for (const char c : kCutting) windows += c == '\n' ? "\r\n" : std::string(1, c);
  for (const char c : kRestarted) expected += c == '\n' ? "\r\n" : std::string(1, c);
  EXPECT_EQ(restart({"--restart-at", "6"}, windows).out, expected);
  windows.resize(windows.size() - 2);
  expected.resize(expected.size() - 2);
  EXPECT_EQ(restart({"--restart-at", "6"}, windows).out, expected);
}

TEST(IsorunRestart, GoesDownAsAsked) {
  EXPECT_THAT(restart({"--restart-at", "6", "--clearance", "25.5", "--approach-feed", "300"}).out,
              HasSubstr("\nZ25.5\nG01 Z-5 F300\nF2000\n"));
  const support::TemporaryFolder folder;
  const std::string machine = folder.write("machine.json", R"({"machine": {"clearance": 12}})");
  EXPECT_THAT(restart({"--restart-at", "6", "--machine", machine}).out, HasSubstr("\nZ12\nG01 Z-5 F1000\nF2000\n"));
  EXPECT_THAT(restart({"--restart-at", "6", "--machine", machine, "--clearance", "8"}).out, HasSubstr("\nZ8\nG01 "));
}

TEST(IsorunRestart, WhereItIsNotSafeNamesTheNearestLines) {
  const CommandResult english = restart({"--restart-at", "8"});
  EXPECT_EQ(english.status, 1);
  EXPECT_EQ(english.out, "");
  EXPECT_EQ(english.err,
            "isorun: <stdin>: no safe restart before line 8: cutter compensation (G41) is in force; "
            "nearest safe line: 7\n");
  EXPECT_EQ(restart({"--restart-at", "8", "--lang", "it"}).err,
            "isorun: <stdin>: nessuna ripresa sicura dalla riga 8: è in presa la correzione raggio fresa (G41); "
            "riga sicura più vicina: 7\n");
}

TEST(IsorunRestart, ThatIsRefusedLeavesTheFileAlone) {
  const support::TemporaryFolder folder;
  const std::string output = folder.write("again.iso", "what stood there before");
  EXPECT_EQ(restart({"--restart-at", "8", "-o", output}).status, 1);
  EXPECT_EQ(content_of(output), "what stood there before");
}

TEST(IsorunRestart, OfAProgramInErrorReportsTheError) {
  const CommandResult result = restart({"--restart-at", "2"}, kBrokenProgram);
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err, "<stdin>:3: error: G01 has no coordinate: write at least one directly after it [ISO026]\n");
}

TEST(IsorunRestart, BeyondTheLastLineIsAFailure) {
  const CommandResult result = restart({"--restart-at", "12"});
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.err, "isorun: <stdin>: there is no line 12: the last one is 11\n");
}

TEST(IsorunRestart, RefusesWhatItDoesNotUnderstand) {
  std::vector<std::vector<std::string>> mistakes = {{"-o", "x.iso"},
                                                    {"--clearance", "5"},
                                                    {"--approach-feed", "5"},
                                                    {"--restart-at", "6", "--until", "7"},
                                                    {"--restart-at", "6", "--trace", "-"},
                                                    {"--restart-at", "6", "--approach-feed", "0"},
                                                    {"--restart-at", "6", "--approach-feed=-5"}};
  for (const std::string line : {"", "0", "-1", "1.5", "x", "N6", "99999999999999999999"})
    mistakes.push_back({"--restart-at=" + line});
  for (const std::string number : {"x", "1e3", "1,5", "nan"}) {
    mistakes.push_back({"--restart-at", "6", "--clearance", number});
    mistakes.push_back({"--restart-at", "6", "--approach-feed", number});
  }
  for (const auto& mistake : mistakes) {
    const CommandResult result = restart(mistake);
    EXPECT_EQ(result.status, 2) << testing::PrintToString(mistake);
    EXPECT_EQ(result.out, "") << testing::PrintToString(mistake);
    EXPECT_THAT(result.err, StartsWith("isorun: ")) << testing::PrintToString(mistake);
  }
}

TEST(IsorunRestart, ComplainsInTheReadersLanguage) {
  EXPECT_EQ(restart({"--restart-at", "0"}).err, "isorun: --restart-at takes a line, counted from 1, not 0\n");
  EXPECT_EQ(restart({"--restart-at", "0", "--lang", "it"}).err,
            "isorun: --restart-at vuole una riga, contata da 1, non 0\n");
  EXPECT_EQ(restart({"--restart-at", "1", "--clearance", "x"}).err,
            "isorun: --clearance takes a plain number of mm, such as 30, not x\n");
  EXPECT_EQ(restart({"--restart-at", "1", "--clearance", "x", "--lang", "it"}).err,
            "isorun: --clearance vuole un numero semplice in mm, come 30, non x\n");
  EXPECT_EQ(restart({"--restart-at", "1", "--approach-feed", "0"}).err,
            "isorun: --approach-feed takes a plain number of mm/min above 0, such as 1000, not 0\n");
  EXPECT_EQ(restart({"--restart-at", "1", "--approach-feed", "0", "--lang", "it"}).err,
            "isorun: --approach-feed vuole un numero semplice in mm/min maggiore di 0, come 1000, non 0\n");
}

TEST(IsorunRestart, DoesNotOverwriteTheProgram) {
  const support::TemporaryFolder folder;
  const std::string file = folder.write("part.iso", kCutting);
  const CommandResult english =
      run_command({"isorun", "--restart-at", "6", "-o", "./part.iso", file}, {.folder = folder.path()});
  EXPECT_EQ(english.status, 2);
  EXPECT_EQ(english.err, "isorun: ./part.iso: this would overwrite the program\n");
  EXPECT_EQ(run_command({"isorun", "--lang", "it", "--restart-at", "6", "-o", file, file}).err,
            "isorun: " + file + ": così si sovrascriverebbe il programma\n");
  EXPECT_EQ(content_of(file), kCutting);
}

/// Z of the nose goes to 0 at most, the tool is 120 mm long.
TEST(IsorunRestart, StaysWithinTheTravelOnItsPath) {
  const auto restart_on = [](const std::string& machine, const std::string& line, const std::string& language = "en") {
    const support::TemporaryFolder folder;
    return run_command(
        {"isorun", "--lang", language, "--machine", folder.write("machine.json", machine), "--restart-at", line, "-"},
        {.input = "G92 Z-300\nM06 T101001\nG00 X10 Y20 Z50\nG01 Z-5 F1000\nX200\nG00 Z60\nX-40\nZ5\n"
                  "G01 Z0\nX20\nG00 Z60\nM02\n"});
  };
  const std::string tools = R"(, "tools": [{"head": 1, "holder": 1, "tool": 1, "length": 120}]}})";
  const CommandResult capped = restart_on(R"({"machine": {"axes": {"Z": {"max": 0}})" + tools, "5");
  EXPECT_EQ(capped.status, 0) << capped.err;
  EXPECT_THAT(capped.out, HasSubstr("; approach\nG00 Z180\nX10 Y20\n")) << "120 mm below home, not at it";
  EXPECT_THAT(restart_on(R"({"machine": {"axes": {})" + tools, "5").out, HasSubstr("; approach\nG00 Z300\n"))
      << "where no travel is known";
  const CommandResult refused = restart_on(R"({"machine": {"axes": {"Z": {"max": 0}, "X": {"min": -10}})" + tools, "9");
  EXPECT_EQ(refused.status, 1);
  EXPECT_EQ(refused.out, "");
  EXPECT_EQ(refused.err,
            "isorun: <stdin>: no safe restart before line 9: on the way there X would go to -40.000 (limit "
            "-10.000)\n");
  EXPECT_THAT(restart_on(R"({"machine": {"axes": {"Z": {"max": -140}})" + tools, "5", "it").err,
              HasSubstr("nessuna ripresa sicura dalla riga 5: sul percorso Z arriverebbe a "));
}

TEST(IsorunRestart, ThatCannotBeWrittenIsAFailure) {
  EXPECT_EQ(restart({"--restart-at", "6", "-o", "/no/such/folder/x"}).status, 2);
  const CommandResult full = restart({"--restart-at", "6", "-o", "/dev/full"});
  EXPECT_EQ(full.status, 2);
  EXPECT_EQ(full.err, "isorun: /dev/full: cannot write: No space left on device\n");
  const CommandResult closed =
      run_command({"isorun", "--restart-at", "6", "-"},
                  {.input = std::string(kCutting), .standard_output = StandardOutput::ClosedPipe});
  EXPECT_EQ(closed.status, 2);
}

/// Each example is taken up again at every line; isolint reports no error in what comes out, and the control runs
/// it to its end.
TEST(IsorunRestart, OfEveryExampleHasNoErrors) {
  const support::TemporaryFolder folder;
  std::size_t written = 0;
  for (const auto& entry : std::filesystem::directory_iterator(ISOCNC_SOURCE_DIR "/examples")) {
    if (entry.path().extension() != ".iso") continue;
    const std::string program = content_of(entry.path());
    const auto lines = std::count(program.begin(), program.end(), '\n');
    for (auto line = 1; line <= lines; line += 3) {
      const std::string output = folder.path(entry.path().stem().string() + "-" + std::to_string(line) + ".iso");
      const CommandResult result =
          run_command({"isorun", "--restart-at", std::to_string(line), "-o", output, entry.path()});
      EXPECT_LE(result.status, 1) << entry.path() << line << result.err;
      EXPECT_EQ(result.status == 0, std::filesystem::exists(output)) << entry.path() << line;
      if (result.status == 0) ++written;
    }
  }
  EXPECT_GT(written, 200u);
  const CommandResult checked =
      run_command({"isolint", "--no-config", "--ignore", "W1", "--max-warnings", "0", folder.path()});
  EXPECT_EQ(checked.status, 0) << checked.out;
}

constexpr std::string_view kTwoTools =
    "G71 G90\n"
    "M06 T101001\n"
    "S12000 M03\n"
    "G00 X10 Y20 Z40\n"
    "G01 Z-5 F2000\n"
    "X100\n"
    "G00 Z40\n"
    "M06 T102003\n"
    "S18000 M03\n"
    "G00 X50 Y60\n"
    "Z2\n"
    "G01 Z-3 F1500\n"
    "Y90\n"
    "G00 Z40\n"
    "M06 T101001\n"
    "S12000 M03\n"
    "G00 X5 Y5 Z30\n"
    "G01 Z0 F500\n"
    "G00 Z40\n"
    "M02\n";

/// From home around the place X100 Y0 to its work.
constexpr std::string_view kAroundAPost =
    "M06 T101001\nS12000 M03\nG00 Y100\nX200\nY0\nZ-2\nG01 X190 F1000\nX180\nG00 Z300\nY100\nM05\nM02\n";

/// The file of that program, in a setup with a fixture.
std::string around_a_post(const support::TemporaryFolder& folder, std::string_view fixture) {
  constexpr std::string_view kShop = R"({"machine": {"home": {"z": 400},
      "tools": [{"head": 1, "holder": 1, "tool": 1, "radius": 5, "length": 100, "shape": "flat"}]},
      "setups": [{"paths": ["*.iso"], "frame": "machine", "fixtures": [)";
  folder.write("isocnc.json", std::string(kShop) + std::string(fixture) + "]}]}");
  return folder.write("part.iso", std::string(kAroundAPost));
}

TEST(IsorunRestart, IsNotWrittenWhereItsWayHitsSomething) {
  const support::TemporaryFolder folder;
  const std::string program = around_a_post(folder, R"({"name": "post", "box": [[90, -20, 0], [110, 20, 500]]})");
  EXPECT_EQ(run_command({"isorun", "--verify", program}).status, 0);
  const CommandResult refused = run_command({"isorun", "--lang", "en", "--restart-at", "8", program});
  EXPECT_EQ(refused.status, 1);
  EXPECT_EQ(refused.out, "");
  EXPECT_THAT(refused.err, HasSubstr("no safe restart before line 8: on the way, the cutter of T101001 hits post"));
  EXPECT_THAT(run_command({"isorun", "--lang", "it", "--restart-at", "8", program}).err,
              HasSubstr("nessuna ripresa sicura dalla riga 8: lungo il percorso, "));
  const CommandResult beside = run_command({"isorun", "--lang", "en", "--restart-at", "4", program});
  EXPECT_EQ(beside.status, 0) << beside.err;
}

/// What the program itself hits is known, and no reason to refuse the rest of it.
TEST(IsorunRestart, IsWrittenWhereOnlyTheProgramItselfHitsSomething) {
  const support::TemporaryFolder folder;
  const std::string program = around_a_post(folder, R"({"name": "bar", "box": [[181, -20, -50], [183, 20, 10]]})");
  EXPECT_EQ(run_command({"isorun", "--verify", program}).status, 1);
  EXPECT_EQ(run_command({"isorun", "--restart-at", "8", program}).status, 0);
  EXPECT_EQ(run_command({"isorun", "--tool", "T101001", program}).status, 0);
}

TEST(IsorunTool, WritesAProgramOfItsOperationAlone) {
  const CommandResult made = restart({"--tool", "T102003"}, kTwoTools);
  EXPECT_EQ(made.err, "");
  EXPECT_EQ(made.status, 0);
  EXPECT_EQ(made.out,
            "; <stdin> alone from line 9 to 14\nG71 G90\nM06 T102003\nS12000\n; approach\nG00 Z40\nX100 Y20\nF2000\n"
            "; the program from line 9 on\nS18000 M03\nG00 X50 Y60\nZ2\nG01 Z-3 F1500\nY90\nG00 Z40\nM05\nM02\n");
  const CommandResult checked = run_command({"isolint", "--lang", "en", "-"}, {.input = made.out});
  EXPECT_EQ(checked.status, 0) << checked.out;
}

TEST(IsorunTool, MeansTheOperationOfAnM06) {
  const CommandResult open = restart({"--tool", "T101001"}, kTwoTools);
  EXPECT_EQ(open.status, 2);
  EXPECT_THAT(open.err,
              HasSubstr("T101001 is mounted more than once, by the M06 of lines 2, 15; --tool T101001@2 means"));
  const CommandResult first = restart({"--tool", "T101001@2"}, kTwoTools);
  EXPECT_THAT(first.out, HasSubstr("G01 Z-5 F2000\nX100\nG00 Z40\nM05\nM02\n"));
  const CommandResult last = restart({"--tool", "101001@15"}, kTwoTools);
  EXPECT_THAT(last.out, HasSubstr("G01 Z0 F500\nG00 Z40\nM05\nM02\n"));
  EXPECT_THAT(last.out, testing::Not(HasSubstr("Z-5")));
}

TEST(IsorunTool, RefusesWhatIsNotThere) {
  EXPECT_THAT(restart({"--tool", "T999001"}, kTwoTools).err, HasSubstr("T999001 is mounted by no M06"));
  EXPECT_THAT(restart({"--tool", "T102003@2"}, kTwoTools).err,
              HasSubstr("T102003 is not mounted there, but by the M06 of: line 8"));
  for (const char* const wrong : {"T1O2003", "T102003@", "@8", "T1234567"}) {
    EXPECT_EQ(restart({"--tool", wrong}, kTwoTools).status, 2) << wrong;
    EXPECT_THAT(restart({"--tool", wrong}, kTwoTools).err, HasSubstr("--tool takes a tool such as")) << wrong;
  }
}

}  // namespace
}  // namespace isocnc::commands
