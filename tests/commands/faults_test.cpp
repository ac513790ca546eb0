#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "run_command.h"
#include "temporary_folder.h"
#include "tests/support/random.h"
#include "tests/support/text_of_file.h"

/// What the world around a command may do to it, and what it owes then: the whole answer, or a word and the status of
/// trouble.
namespace isocnc::commands {
namespace {

namespace fs = std::filesystem;
using testing::AnyOf;
using testing::HasSubstr;

std::string short_moves(int lines) {
  std::string text = "M06 T101001\nS18000 M03\nG00 X0 Y0 Z5\nG01 Z0 F3000\n";
  for (int i = 0; i < lines; ++i) text += "X" + std::to_string(i % 977) + " Y" + std::to_string(i % 31) + ".5\n";
  return text + "G00 Z50\nM05\nM02\n";
}

std::string mistakes(int lines) {
  std::string text;
  for (int i = 0; i < lines; ++i) text += "G71 X" + std::to_string(i % 977) + " Q\n";
  return text;
}

/// By the shell, which a test may limit; the exit status.
int shell(const std::string& command) {
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

class ScarceMemory : public testing::TestWithParam<std::string> {};

TEST_P(ScarceMemory, IsToldOrIsEnough) {
  if (!support::kTriesAll) GTEST_SKIP() << "sanitizers take what address space there is";
  const TemporaryFolder folder;
  folder.write("good.iso", short_moves(100'000));
  folder.write("bad.iso", mistakes(60'000));
  int failures = 0;
  for (int kib = 8'000; kib < 70'000; kib = kib * 5 / 4) {
    const int status = shell("cd " + folder.path() + " && ulimit -v " + std::to_string(kib) +
                             " && LC_ALL=C " ISOCNC_BIN_DIR "/" + GetParam() + " > out 2> err");
    if (status < 2) continue;
    ++failures;
    EXPECT_EQ(status, 2) << kib;
    EXPECT_THAT(text_of_file(folder.path("err")),
                AnyOf(HasSubstr("out of memory"), HasSubstr("Cannot allocate memory")))
        << kib;
  }
  EXPECT_GT(failures, 0);
}

INSTANTIATE_TEST_SUITE_P(Commands, ScarceMemory,
                         testing::Values("isolint --jobs 1 bad.iso", "isolint --jobs 4 good.iso",
                                         "isolint --jobs 4 bad.iso", "isolint --format sarif bad.iso",
                                         "isofmt --stdout good.iso", "isorun good.iso", "isorun --plot p.svg good.iso"),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           for (char& c : name)
                             if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
                           return name;
                         });

TEST(Faults, NoThreadsAreNoTrouble) {
  if (!support::kTriesAll) GTEST_SKIP() << "sanitizers take what address space there is";
  const TemporaryFolder folder;
  folder.write("good.iso", short_moves(100'000));
  // Each thread would take 8 MiB of it for its stack.
  const int status =
      shell("cd " + folder.path() +
            " && ulimit -v 24000 && ulimit -s 16000 && " ISOCNC_BIN_DIR "/isolint --jobs 4 good.iso 2> err");
  EXPECT_EQ(status, 0) << text_of_file(folder.path("err"));
}

/// Byte by byte, and read as slowly.
TEST(Faults, SlowPipesLoseNothing) {
  const TemporaryFolder folder;
  folder.write("bad.iso", mistakes(400));
  const std::string isolint = ISOCNC_BIN_DIR "/isolint --format json --stdin-filename bad.iso -";
  EXPECT_EQ(shell("cd " + folder.path() + " && " + isolint + " < bad.iso > whole"), 1);
  EXPECT_EQ(shell("cd " + folder.path() + " && dd if=bad.iso bs=1 2> err | " + isolint + " | dd bs=7 of=slow 2> err"),
            0);
  const std::string whole = text_of_file(folder.path("whole"));
  EXPECT_GT(whole.size(), 100'000U);
  EXPECT_TRUE(text_of_file(folder.path("slow")) == whole);
}

TEST(Faults, TenWriteOneProgramAndItIsWhole) {
  const TemporaryFolder folder;
  std::string untidy;
  for (int i = 0; i < 20'000; ++i) untidy += "g01   x" + std::to_string(i) + " f500\n";
  const std::string file = folder.write("part.iso", untidy);
  ASSERT_EQ(shell(ISOCNC_BIN_DIR "/isofmt --stdout " + file + " > " + folder.path("tidy")), 0);
  const std::string tidy = text_of_file(folder.path("tidy"));
  ASSERT_NE(tidy, untidy);
  for (int round = 0; round < 5; ++round) {
    folder.write("part.iso", untidy);
    // Who comes too late refuses to write over what another has written; nobody fails else.
    shell("for i in 0 1 2 3 4 5 6 7 8 9; do " ISOCNC_BIN_DIR "/isofmt -i " + file + " 2> " + folder.path("err") +
          "$i & done; wait");
    EXPECT_TRUE(text_of_file(file) == tidy);
  }
  std::size_t left = 0;
  for (const auto& entry : fs::directory_iterator(folder.path()))
    left += entry.path().filename().string().find(".isocnc-") == std::string::npos ? 0 : 1;
  EXPECT_EQ(left, 0U);
}

TEST(Faults, AProgramThatIsGoneIsTold) {
  const TemporaryFolder folder;
  const CommandResult result = run_command({"isolint", folder.path("gone.iso"), folder.path()});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("gone.iso: "));
}

}  // namespace
}  // namespace isocnc::commands
