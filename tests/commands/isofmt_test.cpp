#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/stat.h>

#include <filesystem>

#include "run_command.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text_of_file.h"

namespace isocnc::commands {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

constexpr std::string_view kUntidy = "m06t101001\ng00x10 y0z5 ; up\nM02\n";
constexpr std::string_view kTidy = "M06 T101001\nG00 X10 Y0 Z5 ; up\nM02\n";

std::string format(std::string input, std::vector<std::string> options = {}) {
  options.insert(options.begin(), "isofmt");
  options.emplace_back("-");
  const CommandResult result = run_command(options, {.input = std::move(input)});
  EXPECT_EQ(result.status, 0) << result.err;
  return result.out;
}

TEST(Isofmt, PrintsOneProgram) {
  const support::TemporaryFolder folder;
  const std::string file = folder.write("part.iso", kUntidy);
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"isofmt", file}, {"isofmt", "--stdout", file}}) {
    const CommandResult result = run_command(arguments);
    EXPECT_EQ(result.status, 0);
    EXPECT_EQ(result.out, kTidy);
    EXPECT_EQ(result.err, "");
  }
  EXPECT_EQ(text_of_file(file), kUntidy);
  EXPECT_EQ(format(std::string(kUntidy)), kTidy);
}

TEST(Isofmt, MirrorsPrograms) {
  const support::TemporaryFolder folder;
  constexpr std::string_view kLeft = "m06t101001\r\ng0x10 y0z5 ; up\r\nM02";
  constexpr std::string_view kRight = "m06t101001\r\ng0x790 y0z5 ; up\r\nM02";
  const std::vector<std::string> mirror = {"isofmt", "--mirror", "X", "--about", "400"};
  const auto run = [&](std::vector<std::string> more) {
    more.insert(more.begin(), mirror.begin(), mirror.end());
    return run_command(more, {.folder = folder.path()});
  };
  folder.write("left.iso", kLeft);
  EXPECT_EQ(run({"left.iso"}).out, kRight);
  EXPECT_EQ(run({"--check", "left.iso"}).out, "left.iso\n");
  const CommandResult difference = run({"--diff", "left.iso"});
  EXPECT_EQ(difference.status, 1);
  EXPECT_THAT(difference.out, HasSubstr("-g0x10 y0z5 ; up\r\n+g0x790 y0z5 ; up\r\n"));
  EXPECT_EQ(text_of_file(folder.path("left.iso")), kLeft);
  EXPECT_EQ(run({"-i", "left.iso"}).status, 0);
  EXPECT_EQ(text_of_file(folder.path("left.iso")), kRight);
  EXPECT_EQ(format("\xEF\xBB\xBFM06 T101001\nG00 X1 Y2 Z3\nM02\n", {"--shift", "-1,0.5", "--scale-feed", "2"}),
            "\xEF\xBB\xBFM06 T101001\nG00 X0 Y2.5 Z3\nM02\n");
  EXPECT_EQ(format("M06 T101001\nG00 X1 Y2 Z3\nM02\n", {"--rotate=-90", "--about=0,0"}),
            "M06 T101001\nG00 X2 Y-1 Z3\nM02\n");
}

TEST(Isofmt, LeavesAProgramThatCannotBeMirrored) {
  const support::TemporaryFolder folder;
  constexpr std::string_view kProgram = "M06 T101001\nG00 Y0 Z5\nG01 Y5 F100\nM02\n";
  folder.write("wrong.iso", kProgram);
  folder.write("right.iso", "M06 T101001\nG00 X1 Y0 Z5\nM02\n");
  const CommandResult result = run_command(
      {"isofmt", "-i", "--mirror", "X", "--about", "400", "wrong.iso", "right.iso"}, {.folder = folder.path()});
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.err,
            "isofmt: wrong.iso: not changed: line 3: the feed move starts at a place that the program has not given: "
            "write all its coordinates in a rapid before it\n1 of 2 programs changed\n");
  EXPECT_EQ(text_of_file(folder.path("wrong.iso")), kProgram);
  EXPECT_EQ(text_of_file(folder.path("right.iso")), "M06 T101001\nG00 X799 Y0 Z5\nM02\n");
}

TEST(Isofmt, RefusesTransformationsThatAreNone) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
      {{"--mirror", "X"}, "--mirror goes with --about"},
      {{"--mirror", "X", "--about", "1,2"}, "--mirror goes with --about"},
      {{"--mirror", "X", "--about", "1e9"}, "--mirror goes with --about"},
      {{"--mirror", "Z", "--about", "1"}, "--mirror"},
      {{"--rotate", "90"}, "--rotate takes degrees"},
      {{"--rotate", "nan", "--about", "1,2"}, "--rotate takes degrees"},
      {{"--rotate", "90", "--about", "1,"}, "--rotate takes degrees"},
      {{"--about", "1"}, "--about goes with --mirror or --rotate"},
      {{"--shift", "5"}, "--shift takes a way"},
      {{"--shift", "1,2,3,4"}, "--shift takes a way"},
      {{"--shift", "1,2 (mm)"}, "--shift takes a way"},
      {{"--scale-feed", "0"}, "--scale-feed takes a factor"},
      {{"--scale-feed", "-1"}, "--scale-feed takes a factor"},
      {{"--scale-feed", "0.5", "--renumber", "10:10"}, "change nothing else"},
      {{"--shift", "1,2", "--mirror", "X", "--about", "1"}, "one of --mirror, --rotate, --shift and --repeat"},
      {{"--repeat", "3,2,120"}, "--repeat takes columns and rows"},
      {{"--repeat", "1,1,5,5"}, "--repeat takes columns and rows"},
      {{"--repeat", "100,11,5,5"}, "up to 1000 in all"},
  };
  for (const auto& [options, message] : wrong) {
    std::vector<std::string> command = options;
    command.insert(command.begin(), "isofmt");
    command.emplace_back("-");
    const CommandResult result = run_command(command, {.input = "M02\n"});
    EXPECT_EQ(result.status, 2) << message;
    EXPECT_THAT(result.err, HasSubstr(message));
    EXPECT_EQ(result.out, "");
  }
}

TEST(Isofmt, ProvesThatTheMachineDoesTheSame) {
  EXPECT_EQ(format(std::string(kUntidy), {"--verify"}), kTidy);
  const support::TemporaryFolder folder;
  folder.write("register.iso", "m06t101001\nifv3=1goton5\ng00x10\nn5m02\n");
  const CommandResult result = run_command({"isofmt", "-i", "--verify", "register.iso"}, {.folder = folder.path()});
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.err,
            "isofmt: register.iso: not formatted, since it is not certain that it does the same: an IF compares V3, "
            "which the program does not set\n0 of 1 programs changed\n");
  EXPECT_EQ(text_of_file(folder.path("register.iso")), "m06t101001\nifv3=1goton5\ng00x10\nn5m02\n");
  std::filesystem::copy(ISOCNC_SOURCE_DIR "/examples", folder.path("examples"),
                        std::filesystem::copy_options::recursive);
  const CommandResult examples =
      run_command({"isofmt", "-i", "--verify", "--word-order", "--decimals", "4", "--modal", "fold", "--renumber",
                   "10:10", "--renumber-all", folder.path("examples/door-panel.iso"),
                   folder.path("examples/five-axis.iso"), folder.path("examples/pocket.iso"),
                   folder.path("examples/contour-compensation.iso"), folder.path("examples/option.iso")});
  EXPECT_EQ(examples.status, 0) << examples.err;
  EXPECT_THAT(examples.err, HasSubstr("5 of 5 programs changed"));
}

TEST(Isofmt, TranslatesAProgramOfAnotherControl) {
  const support::TemporaryFolder folder;
  folder.write("part.nc", "%\nO1\nG21 G54 G90\nT1 M6\ng0x0.y0.z5.\nG2 X20. I10. F900.\nM8\nM30\n%\n");
  folder.write("map.json", R"({"tools": {"1": "101001"}, "functions": {"M08": "M108"}})");
  const std::vector<std::string> command = {"isofmt", "--from", "fanuc", "--map", "map.json", "part.nc"};
  std::vector<std::string> with_zero = command;
  with_zero.insert(with_zero.end(), {"--zero", "G54=1,2.5,-3", "--g-digits", "1"});
  const CommandResult whole = run_command(with_zero, {.folder = folder.path()});
  EXPECT_EQ(whole.status, 0);
  EXPECT_EQ(whole.err, "");
  EXPECT_EQ(whole.out,
            "(O1)\nG71 G90\nM06 T101001\nG92 X1 Y2.5 Z-3\nG0 X0. Y0. Z5.\nG2 X20. I10 J0 F900.\nM108\nM02\n");
  const CommandResult partly = run_command(command, {.folder = folder.path()});
  EXPECT_EQ(partly.status, 1);
  EXPECT_THAT(partly.err, StartsWith("part.nc:3:5: where is the zero point of G54, in machine coordinates?"));
  EXPECT_THAT(partly.out, HasSubstr("; NOT TRANSLATED: g0x0.y0.z5.\n"));
  std::vector<std::string> italian = command;
  italian.insert(italian.end(), {"--lang", "it"});
  EXPECT_THAT(run_command(italian, {.folder = folder.path()}).out, HasSubstr("; NON TRADOTTO: G2 X20. I10. F900.\n"));
}

TEST(Isofmt, RefusesToTranslateWhatCannotBeRight) {
  const support::TemporaryFolder folder;
  folder.write("part.nc", "T1 M6\nG0 X1. Y0. Z5.\nM30\n");
  folder.write("whole.nc", "T1 M6\nG0 X1000 Y0 Z5\nM30\n");
  folder.write("map.json", R"({"tools": {"1": "101001"}, "zeros": {"G54": [0, 0, 0]}})");
  folder.write("twice.json", "{\n  \"tools\": {\"1\": \"101001\",\n            \"2\": \"101001\"}\n}\n");
  folder.write("machine.json", R"({"machine": {"tools": []}})");
  std::string binary("G0 X1\0\0", 7);
  folder.write("binary.nc", binary);
  struct Case {
    std::vector<std::string> arguments;
    std::string message;
  };
  for (const auto& [arguments, message] : std::vector<Case>{
           {{"--map", "twice.json", "part.nc"}, "twice.json:3:18: error: tools.2: tool 1 is at 101001 already"},
           {{"--map", "none.json", "part.nc"}, "isofmt: none.json: "},
           {{"--map", ".", "part.nc"}, "isofmt: .: not a file"},
           {{"--map", "map.json", "whole.nc"}, "whole.nc:2:4: X1000 has no decimal point"},
           {{"--map", "map.json", "--config", "machine.json", "part.nc"}, "the control would stop at 1 (M06 T101001)"},
           {{"--zero", "G54=1,2", "part.nc"}, "--zero takes a zero point"},
           {{"--check", "part.nc"}, "--check"},
           {{"-i", "part.nc"}, "--in-place"},
           {{"--verify", "part.nc"}, "--verify"},
           {{"part.nc", "whole.nc"}, "--from takes one program, not 2"},
           {{"binary.nc"}, "binary.nc: "},
           {{"none.nc"}, "none.nc: "},
       }) {
    std::vector<std::string> command = {"isofmt", "--lang", "en", "--from", "fanuc"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    const CommandResult result = run_command(command, {.folder = folder.path()});
    EXPECT_EQ(result.status, 2) << message;
    EXPECT_EQ(result.out, "") << message;
    EXPECT_THAT(result.err, HasSubstr(message));
  }
  EXPECT_EQ(text_of_file(folder.path("part.nc")), "T1 M6\nG0 X1. Y0. Z5.\nM30\n");
  const CommandResult alone = run_command({"isofmt", "--map", "map.json", "part.nc"}, {.folder = folder.path()});
  EXPECT_EQ(alone.status, 2);
  EXPECT_THAT(alone.err, HasSubstr("--from"));
}

TEST(Isofmt, WantsAModeForSeveralPrograms) {
  const support::TemporaryFolder folder;
  folder.write("a.iso", kUntidy);
  folder.write("b.iso", kUntidy);
  const CommandResult result = run_command({"isofmt", folder.path()});
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(result.err, HasSubstr("--check, --diff or -i"));
}

TEST(Isofmt, CountsTheProgramsThatItCouldRead) {
  const support::TemporaryFolder folder;
  folder.write("a.iso", kTidy);
  const CommandResult result = run_command({"isofmt", "--check", "a.iso", "none.iso"}, {.folder = folder.path()});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("0 of 1 programs would be changed\n"));
}

TEST(Isofmt, LeavesWhatIsNoTextAndGoesOn) {
  const support::TemporaryFolder folder;
  folder.write("a.iso", std::string(100, '\0'));
  folder.write("b.iso", kTidy);
  const CommandResult result = run_command({"isofmt", "-i", "a.iso", "b.iso"}, {.folder = folder.path()});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("isofmt: a.iso: looks like a binary file\n"));
  EXPECT_THAT(result.err, HasSubstr(" of 1 program"));
  EXPECT_EQ(text_of_file(folder.path("a.iso")), std::string(100, '\0'));
}

/// Blanks in the name, and a byte-order mark: what is shown can be applied.
TEST(Isofmt, ShowsDifferencesThatCanBeApplied) {
  for (const std::string mark : {"", "\xEF\xBB\xBF"}) {
    const support::TemporaryFolder folder;
    const std::string file = folder.write("a part.iso", mark + std::string(kUntidy));
    for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{
             {"isofmt", "--diff"}, {"isolint", "--diff", "--severity", "W125=info"}}) {
      folder.write("a part.iso", mark + std::string(kUntidy));
      std::vector<std::string> whole = command;
      whole.emplace_back("a part.iso");
      const std::string difference = run_command(whole, {.folder = folder.path()}).out;
      EXPECT_THAT(difference, StartsWith("--- a part.iso\t\n+++ a part.iso\t\n")) << command[0];
      folder.write("difference", difference);
      EXPECT_EQ(std::system(("cd " + folder.path() + " && git apply -p0 difference").c_str()), 0) << difference;
      const std::string applied = text_of_file(file);
      EXPECT_TRUE(applied.starts_with(mark + "M06")) << applied;
    }
  }
}

/// For patch only LF ends a line, whatever ends it for the control (D5).
TEST(Isofmt, ShowsDifferencesThatCanBeAppliedWhateverEndsTheLines) {
  const std::vector<std::vector<std::string>> commands = {{"isofmt"}, {"isolint", "--unsafe-fixes"}};
  for (const std::string before :
       {"m06 t101001\rg71\rg71\rg00 x1\r", "m06 t101001\rG71\rG71\rg00 x1",
        "M06 T101001\rg71\nG71\r\nG71\rg0 x1\nM02\r", "M06 T101001\rG00 X1\n\n\n\n\n\n\nG71\nG71\ng00 x2\nM02\n",
        "M06 T101001\r\n\rG71\r\rG71 g00 x1\r\r\nM02\n"}) {
    for (const std::vector<std::string>& command : commands) {
      const support::TemporaryFolder folder;
      const std::string patched = folder.write("part.iso", before);
      const std::string rewritten = folder.write("other.iso", before);
      const auto run_with = [&](const std::string& option, const std::string& file) {
        std::vector<std::string> whole = command;
        whole.insert(whole.end(), {option, file});
        return run_command(whole, {.folder = folder.path()}).out;
      };
      folder.write("difference", run_with("--diff", "part.iso"));
      run_with(command[0] == "isofmt" ? "-i" : "--fix", "other.iso");
      EXPECT_NE(text_of_file(rewritten), before);
      EXPECT_EQ(std::system(("cd " + folder.path() + " && git apply -p0 --whitespace=nowarn difference").c_str()), 0)
          << text_of_file(folder.path("difference"));
      EXPECT_EQ(text_of_file(patched), text_of_file(rewritten));
    }
  }
}

TEST(Isofmt, ChecksPrograms) {
  const support::TemporaryFolder folder;
  folder.write("a.iso", kUntidy);
  folder.write("b.iso", kTidy);
  folder.write("deep/c.nc", kUntidy);
  const CommandResult result = run_command({"isofmt", "--check", "."}, {.folder = folder.path()});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.out, "a.iso\ndeep/c.nc\n");
  EXPECT_EQ(result.err, "2 of 3 programs would be changed\n");
  EXPECT_EQ(run_command({"isofmt", "--check", folder.path("b.iso")}).status, 0);
  EXPECT_EQ(text_of_file(folder.path("a.iso")), kUntidy);
}

TEST(Isofmt, ShowsDifferences) {
  const support::TemporaryFolder folder;
  std::string text;
  for (int i = 1; i <= 20; ++i) {
    text += i == 2 || i == 12 || i == 19 ? 'x' : 'X';
    text += std::to_string(i);
    text += '\n';
  }
  text.pop_back();
  folder.write("a.iso", text);
  const CommandResult result = run_command({"isofmt", "--diff", "a.iso"}, {.folder = folder.path()});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.out,
            "--- a.iso\n+++ a.iso\n"
            "@@ -1,5 +1,5 @@\n X1\n-x2\n+X2\n X3\n X4\n X5\n"
            "@@ -9,12 +9,12 @@\n X9\n X10\n X11\n-x12\n+X12\n X13\n X14\n X15\n X16\n X17\n X18\n"
            "-x19\n+X19\n X20\n\\ No newline at end of file\n");
  EXPECT_EQ(run_command({"isofmt", "--diff", "-"}, {.input = std::string(kTidy)}).status, 0);
}

TEST(Isofmt, RewritesProgramsInPlace) {
  const support::TemporaryFolder folder;
  const std::string untidy = folder.write("a.iso", kUntidy);
  const std::string tidy = folder.write("b.iso", kTidy);
  ::chmod(untidy.c_str(), 0640);
  struct stat before {};
  struct stat after {};
  ::stat(tidy.c_str(), &before);
  const CommandResult result = run_command({"isofmt", "-i", folder.path()});
  ::stat(tidy.c_str(), &after);
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err, "1 of 2 programs changed\n");
  EXPECT_EQ(text_of_file(untidy), kTidy);
  EXPECT_EQ(before.st_ino, after.st_ino);  // Not touched.
  ::stat(untidy.c_str(), &after);
  EXPECT_EQ(after.st_mode & 0777u, 0640u);
}

TEST(Isofmt, KeepsByteOrderMarksLineEndsAndForeignBytes) {
  const std::string untidy = "\xEF\xBB\xBFg1x1\r\ng1x2(caf\xE9)\rm02 ";
  const std::string tidy = "\xEF\xBB\xBFG1 X1\r\nG1 X2 (caf\xE9)\rM02";
  EXPECT_EQ(format(untidy), tidy);
  const support::TemporaryFolder folder;
  const std::string file = folder.write("a.iso", untidy);
  EXPECT_EQ(run_command({"isofmt", "-i", file}).status, 0);
  EXPECT_EQ(text_of_file(file), tidy);
}

/// What changes first may stand far down.
TEST(Isofmt, RewritesLargePrograms) {
  std::string start;
  while (start.size() < 1'000'000) start += "G1 X1 Y2\n";
  const support::TemporaryFolder folder;
  const std::string file = folder.write("a.iso", start + "g1x5\n" + start);
  EXPECT_EQ(run_command({"isofmt", "-i", file}).status, 0);
  EXPECT_TRUE(text_of_file(file) == start + "G1 X5\n" + start);
}

TEST(Isofmt, TakesStyles) {
  EXPECT_EQ(format("G1 Y2.50 X.5\n", {"--decimals", "3", "--word-order", "--g-digits", "2"}), "G01 X0.5 Y2.5\n");
  EXPECT_EQ(format("G1 X1\nX2\n", {"--modal", "write"}), "G1 X1\nG01 X2\n");
  EXPECT_EQ(format("G1 X1\nG1 X2\n", {"--modal", "fold"}), "G1 X1\nX2\n");
  EXPECT_EQ(format("N1 X1\nX2\n", {"--renumber", "100:5"}), "N100 X1\nX2\n");
  EXPECT_EQ(format("N1 X1\nX2\n", {"--renumber", "100:5", "--renumber-all"}), "N100 X1\nN105 X2\n");
}

TEST(Isofmt, RefusesWhatCannotBeRenumberedAndGoesOn) {
  const support::TemporaryFolder folder;
  const std::string bad = folder.write("a.iso", "if v1=1 goto n5\nn5\nn5\n");
  const std::string good = folder.write("b.iso", "n5 x1\n");
  const CommandResult result = run_command({"isofmt", "-i", "--renumber", "1:1", folder.path()});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("a.iso: not renumbered: line 3 is one more N5"));
  EXPECT_EQ(text_of_file(bad), "if v1=1 goto n5\nn5\nn5\n");
  EXPECT_EQ(text_of_file(good), "N1 X1\n");
  EXPECT_THAT(run_command({"isofmt", "--lang", "it", "--renumber", "1:1", bad}).err,
              HasSubstr("non rinumerato: la linea 3"));
}

TEST(Isofmt, RefusesMistakenCommands) {
  const support::TemporaryFolder folder;
  const std::string file = folder.write("a.iso", kUntidy);
  for (const std::vector<std::string>& options : std::vector<std::vector<std::string>>{
           {},
           {"-i", "-"},
           {"-i", "--check", file},
           {"--check", "-", file},
           {"--renumber", "10", file},
           {"--renumber", "10:0", file},
           {"--renumber", "-1:5", file},
           {"--renumber-all", file},
           {"--decimals", "-1", file},
           {"--modal", "maybe", file},
           {"--check", folder.path("none.iso")},
           {"-i", "/dev/null"},
       }) {
    std::vector<std::string> arguments = options;
    arguments.insert(arguments.begin(), "isofmt");
    const CommandResult result = run_command(arguments);
    const bool changes_nothing = options == std::vector<std::string>{"-i", "/dev/null"};
    EXPECT_EQ(result.status, changes_nothing ? 0 : 2) << testing::PrintToString(options);
    EXPECT_EQ(result.out, "");
    EXPECT_THAT(result.err, Not(IsEmpty()));
  }
  EXPECT_EQ(text_of_file(file), kUntidy);
}

TEST(Isofmt, ReportsLostOutput) {
  const support::TemporaryFolder folder;
  const std::string file = folder.write("a.iso", kUntidy);
  for (const StandardOutput output : {StandardOutput::FullDisk, StandardOutput::ClosedPipe})
    for (const std::string mode : {"--stdout", "--diff", "--check"}) {
      const CommandResult result = run_command({"isofmt", mode, file}, {.standard_output = output});
      EXPECT_EQ(result.status, 2) << mode;
      EXPECT_THAT(result.err, HasSubstr("<stdout>: cannot write")) << mode;
    }
}

TEST(Isofmt, SaysWhatItIs) {
  EXPECT_THAT(run_command({"isofmt", "--version"}).out, StartsWith("isofmt "));
  EXPECT_THAT(run_command({"isofmt", "--help"}).out, HasSubstr("--renumber"));
}

TEST(IsofmtExamples, DoWhatTheyDid) {
  const std::vector<std::string> all = {"--word-order", "--decimals", "3",          "--g-digits", "2",
                                        "--modal",      "write",      "--renumber", "10:10",      "--renumber-all"};
  for (const auto& entry : std::filesystem::directory_iterator(ISOCNC_SOURCE_DIR "/examples")) {
    if (entry.path().extension() != ".iso") continue;
    const support::TemporaryFolder folder;
    const std::string file = folder.write("part.iso", text_of_file(entry.path()));
    std::vector<std::string> arguments = all;
    arguments.insert(arguments.begin(), {"isofmt", "-i", file});
    const CommandResult result = run_command(arguments);
    EXPECT_EQ(result.err, "1 of 1 programs changed\n") << entry.path();
    EXPECT_EQ(run_command({"isolint", "--format", "concise", file}).out, "") << entry.path();
    const std::string events = run_command({"isorun", "--trace", "-", file}).out;
    EXPECT_TRUE(events == run_command({"isorun", "--trace", "-", entry.path()}).out) << entry.path();
  }
}

}  // namespace
}  // namespace isocnc::commands
