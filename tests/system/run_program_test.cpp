#include <gtest/gtest.h>

#include <csignal>
#include <string>
#include <system_error>
#include <variant>

#include "interpreter/system/process.h"

namespace isocnc::system {
namespace {

ProgramEnd end_of(const std::vector<std::string>& command, std::string_view input = {}) {
  auto run = run_program(command, input);
  if (const auto* const error = std::get_if<std::error_code>(&run)) throw std::system_error(*error);
  return std::move(std::get<ProgramEnd>(run));
}

TEST(RunProgram, GivesWhatItWrites) {
  const ProgramEnd end = end_of({"sh", "-c", "echo out; echo err >&2; exit 3"});
  EXPECT_EQ(end.output, "out\n");
  EXPECT_EQ(end.errors, "err\n");
  EXPECT_EQ(end.status, 3);
}

TEST(RunProgram, ArgumentsArriveAsTheyAre) {
  EXPECT_EQ(end_of({"printf", "%s|", "a b", "", "\"c\\\"", "$HOME", "più"}).output, "a b||\"c\\\"|$HOME|più|");
}

/// More than a pipe holds, both ways at once.
TEST(RunProgram, GivesInputWhileItReads) {
  std::string input;
  for (int i = 0; input.size() < 3'000'000; ++i) input += std::to_string(i) + '\n';
  EXPECT_TRUE(end_of({"cat"}, input).output == input);
  const ProgramEnd both = end_of({"sh", "-c", "cat >&2; echo end"}, input);
  EXPECT_TRUE(both.errors == input);
  EXPECT_EQ(both.output, "end\n");
}

TEST(RunProgram, NeedNotReadItsInput) {
  prepare_process();
  EXPECT_EQ(end_of({"true"}, std::string(3'000'000, 'x')).status, 0);
  EXPECT_EQ(end_of({"cat"}).output, "");
}

TEST(RunProgram, TellsOfASignal) {
  EXPECT_EQ(end_of({"sh", "-c", "kill -9 $$"}).status, 128 + 9);
  prepare_process();  // What we ignore ends it as usual.
  EXPECT_EQ(end_of({"sh", "-c", "kill -PIPE $$; echo alive"}).output, "");
}

/// As where we have been started by a server that wants to know nothing of its programs.
TEST(RunProgram, TellsTheStatusWhereSignalsOfEndsAreIgnored) {
  std::signal(SIGCHLD, SIG_IGN);
  EXPECT_EQ(end_of({"false"}).status, 1);
  EXPECT_EQ(std::signal(SIGCHLD, SIG_DFL), SIG_IGN);
}

TEST(RunProgram, FailsWhereThereIsNone) {
  const auto run = run_program({"no-program-of-this-name"}, {});
  ASSERT_TRUE(std::holds_alternative<std::error_code>(run));
  EXPECT_EQ(std::get<std::error_code>(run), std::errc::no_such_file_or_directory);
}

}  // namespace
}  // namespace isocnc::system
