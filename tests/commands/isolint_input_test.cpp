#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <ostream>
#include <regex>
#include <sstream>

#include <nlohmann/json.hpp>

#include "programs.h"
#include "run_command.h"
#include "tests/support/in_child.h"
#include "tests/support/temporary_folder.h"

namespace isocnc::commands {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

/// The file names of concise findings, in their order, each once per run of equal ones.
std::vector<std::string> files_in(const std::string& concise) {
  std::vector<std::string> files;
  std::istringstream lines(concise);
  for (std::string line; std::getline(lines, line);) {
    std::string file = line.substr(0, line.find(':'));
    if (files.empty() || files.back() != file) files.push_back(std::move(file));
  }
  return files;
}

/// The codes of concise findings, in their order.
std::vector<std::string> codes_in(const std::string& concise) {
  static const std::regex kCode(R"(\[([A-Z]+[0-9]+)\]\n)");
  std::vector<std::string> codes;
  for (std::sregex_iterator it(concise.begin(), concise.end(), kCode); it != std::sregex_iterator(); ++it)
    codes.push_back((*it)[1]);
  return codes;
}

CommandResult check_input(std::string input) {
  return run_command({"isolint", "--format", "concise", "-"}, {.input = std::move(input)});
}

TEST(IsolintInput, StandardInputHasTheNameThatItIsGiven) {
  const CommandResult result = run_command({"isolint", "--format", "concise", "--stdin-filename", "dir/part.iso", "-"},
                                           {.input = std::string(kBrokenProgram)});
  EXPECT_THAT(files_in(result.out), ElementsAre("dir/part.iso"));
  EXPECT_THAT(files_in(check_input(std::string(kBrokenProgram)).out), ElementsAre("<stdin>"));
}

TEST(IsolintInput, FilesAreShownInTheOrderGiven) {
  const support::TemporaryFolder folder;
  std::vector<std::string> command = {"isolint", "--format", "concise", "--jobs", "4"};
  std::vector<std::string> expected;
  // Those at the front take longest.
  for (int i = 0; i < 24; ++i) {
    std::string program = "M06 T101001\nG00 X1\nG01\n";
    for (int line = 0; line < (24 - i) * 2000; ++line) program += "G00 X" + std::to_string(line) + "\n";
    const std::string name = std::to_string((i * 7) % 24) + ".iso";
    folder.write(name, program + "M02\n");
    command.push_back(name);
    expected.push_back(name);
  }
  const CommandResult result = run_command(command, {.folder = folder.path()});
  EXPECT_EQ(files_in(result.out), expected);
  EXPECT_EQ(result.status, 1);
}

TEST(IsolintInput, FindsTheSameWithAnyNumberOfJobs) {
  const support::TemporaryFolder folder;
  std::string program = "M06 T101001\nG00 X1\nG01 X2 F100\n";
  for (int line = 0; line < 50'000; ++line) program += line % 5000 == 0 ? "G01\n" : "X" + std::to_string(line) + "\n";
  const std::string file = folder.write("long.iso", program + "M02\n");
  const std::string alone = run_command({"isolint", "--format", "json", "--jobs", "1", file}).out;
  EXPECT_EQ(json::parse(alone).size(), 10u);
  EXPECT_EQ(run_command({"isolint", "--format", "json", "--jobs", "4", file}).out, alone);
}

TEST(IsolintInput, DirectoriesAreSearchedForPrograms) {
  const support::TemporaryFolder folder;
  for (const std::string name : {"b.iso", "a/deep/x.NC", "a/y.cnc", "c.tap", "d.ngc", "notes.txt", ".git/z.iso"})
    folder.write(name, kBrokenProgram);
  const CommandResult result = run_command({"isolint", "--format", "concise"}, {.folder = folder.path()});
  EXPECT_THAT(files_in(result.out), ElementsAre("a/deep/x.NC", "a/y.cnc", "b.iso", "c.tap", "d.ngc"));
  EXPECT_EQ(run_command({"isolint", "--format", "concise", "."}, {.folder = folder.path()}).out, result.out);
  const CommandResult below = run_command({"isolint", "--format", "concise", "a/"}, {.folder = folder.path()});
  EXPECT_THAT(files_in(below.out), ElementsAre("a/deep/x.NC", "a/y.cnc"));
}

TEST(IsolintInput, FilesThatAreNamedMayHaveAnyExtension) {
  const support::TemporaryFolder folder;
  const std::string file = folder.write("notes.txt", kBrokenProgram);
  EXPECT_EQ(run_command({"isolint", file}).status, 1);
}

TEST(IsolintInput, GitIgnoreIsHonoredInAWorkTree) {
  const support::TemporaryFolder folder;
  for (const std::string name : {"kept.iso", "dropped.iso", "old/x.iso"}) folder.write(name, kBrokenProgram);
  folder.write(".gitignore", "dropped.iso\n/old/\n");
  const std::vector<std::string> command = {"isolint", "--format", "concise"};
  const CommandSetup there{.folder = folder.path()};
  EXPECT_THAT(files_in(run_command(command, there).out), ElementsAre("dropped.iso", "kept.iso", "old/x.iso"));
  std::filesystem::create_directory(folder.path(".git"));
  folder.write(".git/HEAD", "ref: refs/heads/main\n");
  EXPECT_THAT(files_in(run_command(command, there).out), ElementsAre("kept.iso"));
  const CommandResult named = run_command({"isolint", "--format", "concise", "dropped.iso"}, there);
  EXPECT_THAT(files_in(named.out), ElementsAre("dropped.iso"));
}

TEST(IsolintInput, EachFileIsCheckedOnce) {
  const support::TemporaryFolder folder;
  folder.write("a.iso", kBrokenProgram);
  const CommandResult result =
      run_command({"isolint", "--format", "concise", "a.iso", "./a.iso", "."}, {.folder = folder.path()});
  EXPECT_EQ(result.out, "a.iso:3:1: error: G01 has no coordinate: write at least one directly after it [ISO026]\n");
}

TEST(IsolintInput, ADirectoryWithoutProgramsIsAFailure) {
  const support::TemporaryFolder folder;
  folder.write("notes.txt", "nothing here");
  const CommandResult english = run_command({"isolint", folder.path()});
  EXPECT_EQ(english.status, 2);
  EXPECT_EQ(english.err, "isolint: no programs found (.iso .nc .cnc .tap .ngc)\n");
  EXPECT_THAT(run_command({"isolint", "--lang", "it", folder.path()}).err, HasSubstr("nessun programma trovato"));
}

TEST(IsolintInput, AMissingFileIsNamedAndTheOthersAreChecked) {
  const support::TemporaryFolder folder;
  folder.write("a.iso", kBrokenProgram);
  const CommandResult result =
      run_command({"isolint", "--format", "concise", "gone.iso", "a.iso"}, {.folder = folder.path()});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(files_in(result.out), ElementsAre("a.iso"));
  EXPECT_EQ(result.err, "isolint: gone.iso: cannot read: No such file or directory\n");
}

TEST(IsolintInput, AFileThatMayNotBeReadIsAFailure) {
  if (!support::child_may_run(ISOCNC_BIN_DIR "/isolint")) GTEST_SKIP() << "only the superuser may run the programs";
  const support::TemporaryFolder folder;
  const std::string file = folder.write("secret.iso", kCleanProgram);
  ::chmod(folder.path().c_str(), 0755);
  ::chmod(file.c_str(), 0);
  const int is_otherwise = support::in_child([&] {
    const CommandResult result = run_command({"isolint", file});
    return result.status == 2 && result.err.find("cannot read: Permission denied") != std::string::npos;
  });
  EXPECT_EQ(is_otherwise, 0);
}

TEST(IsolintInput, AnEmptyProgramLacksItsEnd) {
  const support::TemporaryFolder folder;
  const CommandResult result = run_command({"isolint", "--format", "concise", folder.write("empty.iso", "")});
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(codes_in(result.out), ElementsAre("ISO045"));
  EXPECT_EQ(check_input("").status, 1);
}

TEST(IsolintInput, TheLastLineNeedsNoEnd) {
  EXPECT_EQ(check_input("M06 T101001\nM02").status, 0);
  EXPECT_EQ(check_input("M06 T101001\rM02\r").status, 0);
}

TEST(IsolintInput, StrayBytesAreFindings) {
  const CommandResult null_byte = check_input(std::string("M06 T101001\nG00 X1 \0Y2\nM02\n", 27));
  EXPECT_EQ(null_byte.status, 1);
  EXPECT_THAT(codes_in(null_byte.out), ElementsAre("ISO003"));
  EXPECT_THAT(codes_in(check_input("M06 T101001\nG00 X1 \xFF\xFE\nM02\n").out), ElementsAre("ISO003"));
}

TEST(IsolintInput, CommentsMayHoldAnyBytes) {
  EXPECT_EQ(check_input("(perch\xE9) M06 T101001 ; \x80\xFF\nM02\n").status, 0);
}

struct NoProgram {
  std::string name;
  std::string bytes;
  std::string complaint;

  friend std::ostream& operator<<(std::ostream& out, const NoProgram& file) { return out << file.name; }
};

class IsolintNoProgram : public testing::TestWithParam<NoProgram> {};

TEST_P(IsolintNoProgram, IsRefusedWithAReason) {
  const support::TemporaryFolder folder;
  folder.write("x.iso", GetParam().bytes);
  const CommandResult result = run_command({"isolint", "x.iso"}, {.folder = folder.path()});
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_THAT(result.err, StartsWith("isolint: x.iso: " + GetParam().complaint + "\n"));
  EXPECT_EQ(run_command({"isolint", "-"}, {.input = GetParam().bytes}).status, 2) << "as standard input";
}

/// Each byte of `text` with a NUL before or after it.
std::string widened(std::string_view text, bool little_endian) {
  std::string wide;
  for (const char c : text) wide += little_endian ? std::string{c, '\0'} : std::string{'\0', c};
  return wide;
}

std::string all_bytes(int times) {
  std::string bytes;
  for (int i = 0; i < times; ++i)
    for (int byte = 0; byte < 256; ++byte) bytes += static_cast<char>((byte * 167 + i * 13) % 256);
  return bytes;
}

INSTANTIATE_TEST_SUITE_P(
    Files, IsolintNoProgram,
    testing::Values(NoProgram{"Utf16LittleMarked", "\xFF\xFE" + widened(kCleanProgram, true),
                              "is UTF-16; save it as UTF-8 or ASCII"},
                    NoProgram{"Utf16BigMarked", "\xFE\xFF" + widened(kCleanProgram, false),
                              "is UTF-16; save it as UTF-8 or ASCII"},
                    NoProgram{"Utf16Little", widened(kCleanProgram, true), "is UTF-16; save it as UTF-8 or ASCII"},
                    NoProgram{"Utf16Big", widened(kCleanProgram, false), "is UTF-16; save it as UTF-8 or ASCII"},
                    NoProgram{"Binary", all_bytes(64), "looks like a binary file"}),
    [](const auto& tested) { return tested.param.name; });

constexpr std::size_t kMegabyte = 1'000'000;

std::string repeated(std::string_view piece, std::size_t size) {
  std::string result;
  result.reserve(size + piece.size());
  while (result.size() < size) result += piece;
  return result;
}

TEST(IsolintHugeLine, OneCommentIsNoFailure) {
  const support::TemporaryFolder folder;
  const std::string file = folder.write("huge.iso", "M06 T101001\n;" + std::string(100 * kMegabyte, 'x') + "\nM02\n");
  const CommandResult result = run_command({"isolint", file});
  EXPECT_FALSE(result.timed_out);
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.status, 0);
}

TEST(IsolintHugeLine, OfManyWordsIsCutWithANote) {
  const support::TemporaryFolder folder;
  const std::string file = folder.write("huge.iso", "M06 T101001\n" + repeated("M08 ", 100 * kMegabyte) + "\nM02\n");
  const CommandResult result = run_command({"isolint", "--format", "concise", file});
  EXPECT_FALSE(result.timed_out);
  EXPECT_THAT(codes_in(result.out), testing::Contains("W192"));
}

class IsolintHugeLineOfMistakes : public testing::TestWithParam<std::string> {};

/// Thousands of findings on one line: each must not cost a walk along it.
TEST_P(IsolintHugeLineOfMistakes, EndsInTime) {
  const support::TemporaryFolder folder;
  const std::string file =
      folder.write("huge.iso", "M06 T101001\n" + repeated("G00 X1 Y2 ", 100 * kMegabyte) + "\nM02\n");
  const CommandResult result =
      run_command({"isolint", "--format", GetParam(), file}, {.limit = std::chrono::seconds(60)});
  EXPECT_FALSE(result.timed_out);
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.out, HasSubstr("W192"));
}

INSTANTIATE_TEST_SUITE_P(Formats, IsolintHugeLineOfMistakes, testing::Values("text", "concise", "json"),
                         [](const auto& tested) { return tested.param; });

/// Each finding names its jump; that must not cost a walk to it from the top.
TEST(IsolintManyPaths, FarAfterTheirJumpEndInTime) {
  std::string program = "M06 T101001\nG01 Z5 F100\n";
  for (int i = 0; i < 200'000; ++i) program += "X" + std::to_string(i) + " Y1 Z1\n";
  program += "IF V3 = 1 GOTO N50\nG93\nN50 G00 X3\nG01 X1 F3\n";
  for (int i = 0; i < 20'000; ++i) program += "X" + std::to_string(i) + "\n";
  const support::TemporaryFolder folder;
  const std::string file = folder.write("long.iso", program + "M02\n");
  for (const std::string format : {"text", "json"}) {
    const CommandResult result =
        run_command({"isolint", "--format", format, file}, {.limit = std::chrono::seconds(20)});
    EXPECT_FALSE(result.timed_out) << format;
    EXPECT_EQ(result.status, 1) << format;
  }
}

TEST(IsolintHugeNumber, IsANumber) {
  const std::string digits(kMegabyte, '1');
  EXPECT_EQ(check_input("M06 T101001\nG00 X0." + digits + "\nM02\n").status, 0);
  EXPECT_EQ(check_input("M06 T101001\nG00 X" + std::string(kMegabyte, '0') + "5\nM02\n").status, 0);
  const CommandResult beyond = check_input("M06 T101001\nG00 X" + digits + "\nM02\n");
  EXPECT_FALSE(beyond.timed_out);
  EXPECT_LE(beyond.status, 1);
}

std::vector<std::filesystem::path> examples(const std::string& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".iso") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

TEST(IsolintExamples, AreClean) {
  const auto files = examples(ISOCNC_SOURCE_DIR "/examples");
  ASSERT_THAT(files, testing::Not(IsEmpty()));
  for (const auto& file : files) {
    const CommandResult result = run_command({"isolint", "--format", "concise", file});
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(result.status, 0) << file;
  }
}

TEST(IsolintExamples, AreBrokenWhereTheySaySo) {
  for (const auto& file : examples(ISOCNC_SOURCE_DIR "/examples")) {
    const auto twin = file.parent_path() / "broken" / file.filename();
    ASSERT_TRUE(std::filesystem::exists(twin)) << twin;
    EXPECT_EQ(run_command({"isolint", "--format", "concise", twin}).status, 1) << twin;
  }
}

}  // namespace
}  // namespace isocnc::commands
