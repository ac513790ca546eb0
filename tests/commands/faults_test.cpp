#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "framed.h"
#include "run_command.h"
#include "tests/support/random.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text_of_file.h"

/// What the world around a command may do to it, and what it owes then: the whole answer, or a word and the status of
/// failures.
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

using Json = nlohmann::json;

/// Opens a program, asks for all that takes memory, and ends.
std::string editor_s_messages(const std::string& program) {
  const Json document = {{"uri", "untitled:part"}};
  std::string all;
  int id = 0;
  const auto ask = [&](const char* method, const Json& params) {
    all += frame(Json{{"jsonrpc", "2.0"}, {"id", ++id}, {"method", method}, {"params", params}}.dump());
  };
  ask("initialize", {{"processId", nullptr}, {"capabilities", Json::object()}});
  const Json opened = {{"uri", "untitled:part"}, {"version", 1}, {"text", program}};
  const Json open = {{"jsonrpc", "2.0"}, {"method", "textDocument/didOpen"}, {"params", {{"textDocument", opened}}}};
  all += frame(open.dump());
  for (const char* const method : {"textDocument/semanticTokens/full", "textDocument/codeLens", "isocnc/toolpath"})
    ask(method, {{"textDocument", document}});
  ask("shutdown", nullptr);
  return all + frame(R"({"jsonrpc":"2.0","method":"exit"})");
}

std::string debugger_s_messages(const std::string& program) {
  std::string all;
  int seq = 0;
  const auto ask = [&](const char* command, const Json& arguments = Json::object()) {
    all += frame(Json{{"seq", ++seq}, {"type", "request"}, {"command", command}, {"arguments", arguments}}.dump());
  };
  ask("initialize");
  ask("launch", {{"program", program}, {"stopOnEntry", true}});
  ask("configurationDone");
  ask("stackTrace", {{"threadId", 1}});
  ask("disconnect");
  return all;
}

/// By the shell, which a test may limit; the exit status.
int shell(const std::string& command) {
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

class ScarceMemory : public testing::TestWithParam<std::string> {};

TEST_P(ScarceMemory, IsReportedOrIsEnough) {
  if (!support::kTriesAll) GTEST_SKIP() << "sanitizers take what address space there is";
  const support::TemporaryFolder folder;
  folder.write("good.iso", short_moves(100'000));
  folder.write("bad.iso", mistakes(60'000));
  folder.write("editor", editor_s_messages(short_moves(100'000)));
  folder.write("debugger", debugger_s_messages(folder.path("good.iso")));
  const auto limited = [&](int kib, const std::string& command) {
    return shell("cd " + folder.path() + " && ulimit -v " + std::to_string(kib) + " && LC_ALL=C " ISOCNC_BIN_DIR "/" +
                 command + " > out 2> err");
  };
  constexpr int kMost = 70'000;
  // What the loader and the libraries take before main() is between these.
  int too_little = 0;
  int enough = kMost;
  while (enough - too_little > 64) {
    const int kib = (too_little + enough) / 2;
    (limited(kib, GetParam().substr(0, GetParam().find(' ')) + " --version") > 2 ? too_little : enough) = kib;
  }
  int failures = 0;
  // Finely at first: some need little more than that.
  for (int more = 0; enough + more < kMost; more = more * 3 / 2 + 64) {
    const int kib = enough + more;
    const int status = limited(kib, GetParam());
    if (status < 2) continue;
    ++failures;
    EXPECT_EQ(status, 2) << kib;
    EXPECT_THAT(text_of_file(folder.path("err")),
                AnyOf(HasSubstr("out of memory"), HasSubstr("Cannot allocate memory"),
                      HasSubstr("Resource temporarily unavailable")))  // The error for a thread without a stack.
        << kib;
  }
  EXPECT_GT(failures, 0);
}

INSTANTIATE_TEST_SUITE_P(Commands, ScarceMemory,
                         testing::Values("isolint --jobs 1 bad.iso", "isolint --jobs 4 good.iso",
                                         "isolint --jobs 4 bad.iso", "isolint --format sarif bad.iso",
                                         "isofmt --stdout good.iso", "isorun good.iso", "isorun --plot p.svg good.iso",
                                         "isols < editor", "isodap < debugger"),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           for (char& c : name)
                             if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
                           return name;
                         });

TEST(Faults, NoThreadsAreNoFailure) {
  if (!support::kTriesAll) GTEST_SKIP() << "sanitizers take what address space there is";
  const support::TemporaryFolder folder;
  folder.write("good.iso", short_moves(100'000));
  // Each thread would take more than there is for its stack.
  const int status =
      shell("cd " + folder.path() +
            " && ulimit -v 40000 && ulimit -s 64000 && " ISOCNC_BIN_DIR "/isolint --jobs 4 good.iso 2> err");
  EXPECT_EQ(status, 0) << text_of_file(folder.path("err"));
}

/// Byte by byte, and read as slowly.
TEST(Faults, SlowPipesLoseNothing) {
  const support::TemporaryFolder folder;
  folder.write("bad.iso", mistakes(400));
  const std::string isolint = ISOCNC_BIN_DIR "/isolint --format json --stdin-filename bad.iso -";
  EXPECT_EQ(shell("cd " + folder.path() + " && " + isolint + " < bad.iso > whole"), 1);
  EXPECT_EQ(shell("cd " + folder.path() + " && dd if=bad.iso bs=1 2> err | " + isolint + " | dd bs=7 of=slow 2> err"),
            0);
  const std::string whole = text_of_file(folder.path("whole"));
  EXPECT_GT(whole.size(), 100'000U);
  EXPECT_TRUE(text_of_file(folder.path("slow")) == whole);
}

/// A command that is read slowly, while another program writes over the one that it reads, in place: larger files are
/// mapped, so that it sees bytes of both. What it says is of neither, but it ends by itself.
class WrittenOver : public testing::TestWithParam<std::string> {};

TEST_P(WrittenOver, IsReadToTheEnd) {
  const support::TemporaryFolder folder;
  std::string text = "M06 T101001\n";
  for (int i = 0; i < 800'000; ++i) text += "G71 G00 X" + std::to_string(i % 1'000) + "\n";
  const std::string file = folder.write("large.iso", text);
  const std::string command = std::string(ISOCNC_BIN_DIR "/") + GetParam() + " " + file + " 2> " + folder.path("err") +
                              "; echo $? > " + folder.path("status");
  std::FILE* const output = ::popen(command.c_str(), "r");
  ASSERT_NE(output, nullptr);
  EXPECT_NE(std::fgetc(output), EOF);
  std::fstream writing(file, std::ios::in | std::ios::out | std::ios::binary);
  for (std::size_t i = 1; i < 64; ++i) {
    writing.seekp(static_cast<std::streamoff>(i * text.size() / 64));
    writing << std::string(text.size() / 128, "\n(;XN\rI"[i % 7]) << std::flush;
  }
  while (std::fgetc(output) != EOF) {
  }
  ::pclose(output);
  EXPECT_THAT(text_of_file(folder.path("status")), AnyOf("0\n", "1\n")) << text_of_file(folder.path("err"));
}

INSTANTIATE_TEST_SUITE_P(Commands, WrittenOver,
                         testing::Values("isofmt --stdout", "isolint --jobs 1 --format concise",
                                         "isolint --jobs 4 --format concise", "isorun --trace -"),
                         [](const auto& tested) { return std::to_string(tested.index); });

TEST(Faults, TenWriteOneProgramAndItIsWhole) {
  const support::TemporaryFolder folder;
  std::string untidy;
  for (int i = 0; i < 20'000; ++i) untidy += "g01   x" + std::to_string(i) + " f500\n";
  const std::string file = folder.write("part.iso", untidy);
  ASSERT_EQ(shell(ISOCNC_BIN_DIR "/isofmt --stdout " + file + " > " + folder.path("tidy")), 0);
  const std::string tidy = text_of_file(folder.path("tidy"));
  ASSERT_NE(tidy, untidy);
  for (int round = 0; round < 5; ++round) {
    folder.write("part.iso", untidy);
    // The last ones refuse to overwrite what another has written; none fails otherwise.
    shell("for i in 0 1 2 3 4 5 6 7 8 9; do " ISOCNC_BIN_DIR "/isofmt -i " + file + " 2> " + folder.path("err") +
          "$i & done; wait");
    EXPECT_TRUE(text_of_file(file) == tidy);
  }
  std::size_t left = 0;
  for (const auto& entry : fs::directory_iterator(folder.path()))
    left += entry.path().filename().string().find(".isocnc-") == std::string::npos ? 0 : 1;
  EXPECT_EQ(left, 0U);
}

TEST(Faults, ARemovedProgramIsReported) {
  const support::TemporaryFolder folder;
  const CommandResult result = run_command({"isolint", folder.path("gone.iso"), folder.path()});
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("gone.iso: "));
}

}  // namespace
}  // namespace isocnc::commands
