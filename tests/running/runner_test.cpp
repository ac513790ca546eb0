#include "interpreter/running/runner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "tests/simulation/random_run.h"

namespace isocnc::running {
namespace {

using support::Random;
using support::seeds;
using testing::ElementsAre;

constexpr std::string_view kJumps =
    "M06 T101001\n"
    "V1=1\n"
    "\n"
    "IF V1=1 GOTO N20\n"
    "N10 V2=1\n"
    "N20 V3=1\n"
    "N10 M02\n";

std::vector<std::string> events_of(Runner runner) {
  std::vector<std::string> reported;
  while (!runner.has_ended()) {
    runner.step();
    for (const Event& event : runner.events()) reported.push_back(to_json(event));
  }
  return reported;
}

TEST(Runner, ExecutesLineByLine) {
  const Program program(kJumps);
  const RunOptions options;
  Runner runner(program, options);
  std::vector<std::uint64_t> lines;
  for (; const auto block = runner.next(); runner.step()) lines.push_back(block->line + 1);
  EXPECT_THAT(lines, ElementsAre(1, 2, 3, 4, 6, 7));
  EXPECT_TRUE(runner.has_ended());
  EXPECT_EQ(runner.result().ending, Ending::ProgramEnd);
  EXPECT_EQ(runner.result().blocks, 5u);
  EXPECT_EQ(runner.result().registers[2], 0);
  EXPECT_EQ(runner.result().registers[3], 1);
}

/// From the tool change to the first feed move or user M; a rapid and an M of the spindle do not use the tool.
TEST(Runner, KnowsWhetherTheToolHasBeenUsed) {
  const Program program(
      "G00 X1\nM06 T101001\nG00 X2\nS9000 M03\nG01 X3 F100\nG00 X4\nM06 T101002\nM100\nM06 T000000\nM02\n");
  const RunOptions options{.stop_at_errors = false};
  Runner runner(program, options);
  std::vector<std::uint64_t> unused_before;
  for (; const auto block = runner.next(); runner.step())
    if (block->is_tool_unused) unused_before.push_back(block->line + 1);
  EXPECT_THAT(unused_before, ElementsAre(3, 4, 5, 8));
}

TEST(Runner, PassesEmptyLines) {
  const Program program("M06 T101001\n; note\n\nN7 (note)\nG1 X1 F100\n\n");
  const RunOptions options;
  Runner runner(program, options);
  runner.step();
  runner.pass_empty_lines();
  EXPECT_EQ(runner.place().line, 4u);
  runner.step();
  runner.pass_empty_lines();
  EXPECT_FALSE(runner.next());
  EXPECT_FALSE(runner.has_ended()) << "what is missing is an error of its own";
  runner.step();
  EXPECT_TRUE(runner.has_ended());
  EXPECT_EQ(dialect::definition(runner.result().error.id).code, "ISO045");
}

TEST(Runner, StandsBeforeTheBlockInError) {
  const Program program("M06 T101001\nV1=2 G02 X1 F100\nM02\n");
  const RunOptions options;
  Runner runner(program, options);
  runner.step();
  const Runner before = runner;
  runner.step();
  EXPECT_TRUE(runner.has_ended());
  EXPECT_TRUE(runner.events().empty());
  EXPECT_EQ(runner.place(), before.place());
  EXPECT_EQ(runner.result().state, before.result().state);
  EXPECT_EQ(runner.result().registers, before.result().registers);
}

/// With its line break lost, the second block has its own F, S and jump, and is skipped by a jump of the first.
TEST(Runner, ExecutesBothBlocksOfALine) {
  const Program program(
      "M06 T101001\n"
      "N10 G01 X5 F100 S500 N20 X9 F200 S800\n"
      "N30 IF VGPL = 1 GOTO N90 N40 IF VGPL = 0 GOTO N60\n"
      "V1 = 1\n"
      "N60 V2 = 1\n"
      "N70 IF VGPL = 0 GOTO N90 N80 V3 = 1\n"
      "V4 = 1\n"
      "N90 M02\n");
  const RunOptions options{.stop_at_errors = false};
  Runner runner(program, options);
  while (!runner.has_ended()) runner.step();
  const RunResult& result = runner.result();
  EXPECT_EQ(result.ending, Ending::ProgramEnd);
  EXPECT_EQ(result.state.last_feed.number, 200);
  EXPECT_EQ(result.state.spindle_speed, 800);
  EXPECT_EQ(result.registers[1], 0);
  EXPECT_EQ(result.registers[2], 1);
  EXPECT_EQ(result.registers[3], 0);
  EXPECT_EQ(result.registers[4], 0);
}

TEST(Runner, DecidesJumpsByWhatHasBeenSet) {
  const Program program("IF VGPL=2 GOTO N5\nV1=1\nIF V1=7 GOTO N5\nM02\nN5\nM02\n");
  const RunOptions options;
  Runner runner(program, options);
  Runner other = runner;
  other.set_vgpl(2);
  other.step();
  EXPECT_EQ(other.place().line, 4u);
  runner.step();
  runner.step();
  EXPECT_EQ(runner.place().line, 2u);
  runner.set_register(1, 7);
  runner.step();
  EXPECT_EQ(runner.place().line, 4u);
}

TEST(Runner, StopsWhereAJumpLeadsOverTheLineAskedFor) {
  const Program program(kJumps);
  RunOptions options;
  options.until = 4;
  Runner runner(program, options);
  while (!runner.has_ended()) runner.step();
  EXPECT_EQ(runner.result().ending, Ending::Until);
  EXPECT_EQ(runner.result().line, 5u);
  EXPECT_EQ(runner.result().jumped_over_from, 3u);
}

TEST(Run, EndsWhereItsCallerWantsItStopped) {
  std::string text;
  for (int line = 0; line < 5000; ++line) text += "V1 = 1\n";
  int asked = 0;
  std::size_t blocks = 0;
  const RunOptions options{.before_block = [&](const Block&) { ++blocks; }, .stop = [&] { return ++asked == 3; }};
  const RunResult result = run(text + "M02\n", options, [](const Event&) {});
  EXPECT_EQ(result.ending, Ending::Stopped);
  EXPECT_EQ(asked, 3);
  EXPECT_EQ(result.line, blocks);
  EXPECT_GT(blocks, 0u);
  EXPECT_LT(blocks, 5000u);

  const RunOptions at_once{.stop = [] { return true; }};
  EXPECT_EQ(run("M02\n", at_once, [](const Event&) { ADD_FAILURE() << "nothing is executed"; }).line, 0u);
  const RunOptions never{.stop = [] { return false; }};
  EXPECT_EQ(run(text + "M02\n", never, [](const Event&) {}).ending, Ending::ProgramEnd);
}

/// Wherever a run is stopped, its copy does what it does, and what a run in one go has left to do.
TEST(RunnerProperty, CopiesGoOnAsTheOriginal) {
  for (const std::uint64_t seed : seeds(60)) {
    Random random(seed);
    const std::string text = simulation::RandomRun(random).text(3);
    const Program program(text);
    const RunOptions options;
    std::vector<std::string> all;
    const RunResult result = run(text, options, [&](const Event& event) { all.push_back(to_json(event)); });
    Runner runner(program, options);
    std::vector<std::string> reported;
    while (!runner.has_ended()) {
      const Runner copy = runner;
      if (random.one_in(5)) {
        std::vector<std::string> rest(all.begin() + static_cast<std::ptrdiff_t>(reported.size()), all.end());
        ASSERT_EQ(events_of(copy), rest) << seed;
      }
      if (random.one_in(2)) runner = copy;
      runner.step();
      for (const Event& event : runner.events()) reported.push_back(to_json(event));
    }
    EXPECT_EQ(reported, all) << seed;
    EXPECT_EQ(runner.result().state, result.state) << seed;
    EXPECT_EQ(runner.result().blocks, result.blocks) << seed;
  }
}

TEST(Program, IsSharedByThreads) {
  const Program program(kJumps);
  const RunOptions options;
  std::vector<std::vector<std::string>> reported(4);
  std::vector<std::thread> threads;
  for (std::vector<std::string>& mine : reported)
    threads.emplace_back([&] { mine = events_of(Runner(program, options)); });
  for (std::thread& thread : threads) thread.join();
  EXPECT_THAT(reported, testing::Each(events_of(Runner(program, options))));
  EXPECT_EQ(reported.front().size(), 3u);
}

}  // namespace
}  // namespace isocnc::running
