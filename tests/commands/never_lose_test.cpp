#include "run_command.h"
#include "tests/support/in_child.h"
#include "tests/support/random.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text_of_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <vector>

namespace isocnc::commands {
namespace {

namespace fs = std::filesystem;
using support::in_child;
using testing::HasSubstr;

/// A command that puts a new text in the place of an old one, or where there is none.
struct Rewriter {
  std::string name;
  std::vector<std::string> arguments;
  std::string file;
  std::string before;
};

std::string untidy_program(int lines) {
  std::string text = "m06 t101001\ng71 g00 x0\n";
  for (int i = 0; i < lines; ++i) text += "g71 g00 x" + std::to_string(i) + "  ;isolint\n";
  return text + "m02\n";
}

std::vector<Rewriter> rewriters() {
  const std::string program = untidy_program(2'000);
  return {
      {"isofmt", {"isofmt", "-i", "part.iso"}, "part.iso", program},
      {"isolint", {"isolint", "--fix", "part.iso", "--format", "concise"}, "part.iso", program},
      {"baseline", {"isolint", "--write-baseline", "known.json", "part.iso"}, "known.json", "{\"old\": true}\n"},
      {"report", {"isolint", "--output", "report.txt", "part.iso"}, "report.txt", "old\n"},
      {"trace", {"isorun", "--trace", "trace.jsonl", "part.iso"}, "trace.jsonl", "old\n"},
      {"samples", {"isorun", "--samples", "samples.jsonl", "--dt", "0.05", "part.iso"}, "samples.jsonl", "old\n"},
      {"plot", {"isorun", "--plot", "path.svg", "part.iso"}, "path.svg", "old\n"},
      {"restart", {"isorun", "--restart-at", "100", "-o", "rest.iso", "part.iso"}, "rest.iso", "old\n"},
  };
}

/// A command, and a folder with what it rewrites, which anybody may write.
class NeverLose : public testing::TestWithParam<Rewriter> {
 protected:
  NeverLose() {
    folder.write("part.iso", untidy_program(2'000));
    folder.write(GetParam().file, GetParam().before);
    for (const auto& entry : fs::directory_iterator(folder.path())) fs::permissions(entry, fs::perms(0666));
    files = files_in_folder();
    fs::permissions(folder.path(), fs::perms::all);
  }
  ~NeverLose() override { fs::permissions(folder.path(), fs::perms::all); }

  CommandResult run() const { return run_command(GetParam().arguments, {.folder = folder.path()}); }
  std::string text() const { return text_of_file(folder.path(GetParam().file)); }
  std::size_t files_in_folder() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()));
  }
  void expect_untouched() const {
    EXPECT_TRUE(text() == GetParam().before);
    EXPECT_EQ(files_in_folder(), files);
  }
  /// Ends with the status of a failure, and says why.
  bool fails_with(std::string_view reason) const {
    const CommandResult result = run();
    const bool is_right = result.status == 2 && result.err.find(reason) != std::string::npos;
    if (!is_right) std::fprintf(stderr, "status %d: %s\n", result.status, result.err.c_str());
    return is_right;
  }
  /// What the command makes of the file when nothing stands in its way.
  std::string text_afterwards() const {
    run();
    const std::string after = text();
    folder.write(GetParam().file, GetParam().before);
    return after;
  }

  const support::TemporaryFolder folder;
  std::size_t files = 0;
};

TEST_P(NeverLose, OnADiskThatFillsUp) {
  if (!support::child_may_run(ISOCNC_BIN_DIR "/isolint")) GTEST_SKIP() << "only the superuser may run the programs";
  for (const rlim_t limit : {rlim_t{0}, rlim_t{1}, rlim_t{4096}, rlim_t{20'000}}) {
    EXPECT_EQ(in_child([&] { return fails_with("cannot write: File too large"); }, limit), 0) << limit;
    expect_untouched();
  }
}

TEST_P(NeverLose, InAFolderThatMayNotBeWritten) {
  if (!support::child_may_run(ISOCNC_BIN_DIR "/isolint")) GTEST_SKIP() << "only the superuser may run the programs";
  fs::permissions(folder.path(), fs::perms(0555));
  EXPECT_EQ(in_child([&] { return fails_with("cannot write: Permission denied"); }), 0);
  expect_untouched();
}

/// From so few open files that the command does not begin to so many that it succeeds.
TEST_P(NeverLose, WithFewFilesOpenAtOnce) {
  if (GetParam().name == "report") GTEST_SKIP() << "reports the programs that could be read, even if there are none";
  if (!support::kTriesAll) GTEST_SKIP() << "sanitizers open files of their own, and end the program where they cannot";
  const std::string after = text_afterwards();
  ASSERT_TRUE(after != GetParam().before);
  bool has_failed = false;
  bool has_succeeded = false;
  for (int limit = 3; limit < 40 && !has_succeeded; ++limit) {
    std::string command =
        "cd " + folder.path() + " && { ulimit -n " + std::to_string(limit) + " && " ISOCNC_BIN_DIR "/";
    for (const std::string& argument : GetParam().arguments) command += argument + " ";
    const int status = std::system((command + "; } > /dev/null 2>&1").c_str());
    has_succeeded = text() == after;
    if (has_succeeded) break;
    EXPECT_NE(status, 0) << limit;
    has_failed = true;
    expect_untouched();
  }
  EXPECT_TRUE(has_failed);
  EXPECT_TRUE(has_succeeded);
}

TEST_P(NeverLose, WhenKilled) {
  const std::string after = text_afterwards();
  for (int i = 0; i < 60; ++i) {
    run_command(GetParam().arguments, {.folder = folder.path(), .limit = std::chrono::microseconds(300 * i)});
    const std::string now = text();
    EXPECT_TRUE(now == after || now == GetParam().before) << i << ": " << now.size();
    folder.write(GetParam().file, GetParam().before);
  }
}

/// What is made where nothing was is there whole, or not at all.
TEST_P(NeverLose, WhenKilledBeforeThereIsAFile) {
  if (GetParam().file == "part.iso") GTEST_SKIP() << "a program is there";
  const std::string after = text_afterwards();
  for (int i = 0; i < 30; ++i) {
    fs::remove(folder.path(GetParam().file));
    run_command(GetParam().arguments, {.folder = folder.path(), .limit = std::chrono::microseconds(600 * i)});
    const bool is_made = fs::exists(folder.path(GetParam().file));
    EXPECT_TRUE(!is_made || text() == after) << i << ": " << text().size();
  }
}

INSTANTIATE_TEST_SUITE_P(Commands, NeverLose, testing::ValuesIn(rewriters()),
                         [](const auto& tested) { return tested.param.name; });

/// Ctrl-C at some moment, most likely while the new text is being written: nothing is left beside the program.
TEST(NeverLeave, WhenInterrupted) {
  const support::TemporaryFolder folder;
  const std::string before = untidy_program(500'000);
  const std::string file = folder.write("part.iso", before);
  const std::string command = "exec 2> /dev/null; cd " + folder.path() +
                              " && exec " ISOCNC_BIN_DIR "/isofmt -i part.iso & pid=$!; " + "while [ $(ls -A " +
                              folder.path() + " | wc -l) = 1 ] && kill -0 $pid; do :; done; " +
                              "kill -TERM $pid; wait $pid; exit 0";
  EXPECT_EQ(std::system(command.c_str()), 0);
  const bool is_old = text_of_file(file) == before;
  EXPECT_TRUE(is_old || text_of_file(file).ends_with("M02\n"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 1);
}

/// A command that is read slowly, so that the program is cut short after it has been opened and before its last byte
/// has been looked at.
class CutShort : public testing::TestWithParam<std::string> {};

TEST_P(CutShort, IsReportedAndEndsTheRun) {
  const support::TemporaryFolder folder;
  std::string text = "M06 T101001\n";
  for (int i = 0; i < 800'000; ++i) text += "G71 G00 X" + std::to_string(i % 1'000) + "\n";  // A warning for isolint.
  const std::string file = folder.write("large.iso", text);
  const std::string command = std::string("LC_ALL=C " ISOCNC_BIN_DIR "/") + GetParam() + " " + file + " 2> " +
                              folder.path("err") + "; echo $? > " + folder.path("status");
  std::FILE* const output = ::popen(command.c_str(), "r");
  ASSERT_NE(output, nullptr);
  EXPECT_NE(std::fgetc(output), EOF);
  fs::resize_file(file, 100);
  while (std::fgetc(output) != EOF) {
  }
  ::pclose(output);
  EXPECT_EQ(text_of_file(folder.path("status")), "2\n");
  EXPECT_THAT(text_of_file(folder.path("err")),
              HasSubstr(file + ": has been cut short by another program while it was being read\n"));
}

INSTANTIATE_TEST_SUITE_P(Commands, CutShort,
                         testing::Values("isofmt --stdout", "isolint --format text", "isorun --trace -"),
                         [](const auto& tested) { return tested.param.substr(0, tested.param.find(' ')); });

}  // namespace
}  // namespace isocnc::commands
