#include "interpreter/simulation/history.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "random_run.h"

namespace isocnc::simulation {
namespace {

using support::Random;
using support::seeds;

/// Low limits, so that checkpoints are thinned out repeatedly.
constexpr History::CheckpointLimits kFew{.checkpoints = 5, .nearby = 3, .spacing = 8};

class HistoryTest : public testing::Test {
 protected:
  const Simulation& begin(std::string text, double vgpl = 0, bool limits_jerk = false) {
    text_ = std::move(text);
    machine_ = machine_of_tests(limits_jerk);
    options_ = options_for(machine_);
    options_.vgpl = vgpl;
    program_.emplace(text_);
    begin_.emplace(*program_, options_, machine_);
    return *begin_;
  }

  /// A new run that stops after `blocks` blocks, with VGPL set before block `set_before`.
  Simulation fresh_before(std::uint64_t blocks, int set_before = -1, double vgpl = 0) const {
    Simulation fresh = *begin_;
    while (!fresh.has_ended() && fresh.blocks() < blocks) {
      if (static_cast<int>(fresh.blocks()) == set_before) fresh.set_vgpl(vgpl);
      fresh.step_block();
    }
    if (static_cast<int>(fresh.blocks()) == set_before) fresh.set_vgpl(vgpl);
    return fresh;
  }

 private:
  std::string text_;
  running::RunOptions options_;
  timing::TimedMachine machine_;
  std::optional<running::Program> program_;
  std::optional<Simulation> begin_;
};

TEST_F(HistoryTest, StepsBackBlockByBlock) {
  History history(begin("M06 T101001\nG1 X10 F6000\nX20\n\nX30\nM02\n"));
  for (int i = 0; i < 3; ++i) history.step_block();
  history.advance_along(3);
  EXPECT_EQ(history.present().line(), 4u);
  history.step_back();
  EXPECT_FALSE(history.present().is_in_block());
  EXPECT_EQ(history.present().line(), 4u) << "to the begin of the block in progress";
  history.step_back();
  EXPECT_EQ(history.present().line(), 2u);
  for (int i = 0; i < 5; ++i) history.step_back();
  EXPECT_EQ(history.present().line(), 0u);
  EXPECT_EQ(history.present().time(), 0);
}

TEST_F(HistoryTest, StepsBackFromAnErrorToBeforeIt) {
  History history(begin("M06 T101001\nG1 X10 F6000\nG2 X20\nM02\n"));
  history.go_to_block(100);
  EXPECT_TRUE(history.present().has_ended());
  history.step_back();
  EXPECT_FALSE(history.present().has_ended());
  EXPECT_EQ(history.present().line(), 2u);
  EXPECT_EQ(history.present().blocks(), 2u);
}

TEST_F(HistoryTest, StepsBackFromAJumpThatLeadsNowhere) {
  History history(begin("M06 T101001\nG1 X10 F6000\nIF VGPL=0 GOTO N7\nM02\n"));
  history.go_to_block(100);
  EXPECT_TRUE(history.present().has_ended());
  history.step_back();
  EXPECT_FALSE(history.present().has_ended());
  EXPECT_EQ(history.present().line(), 2u);
}

TEST_F(HistoryTest, StepsBackFromTheEndToBeforeM02) {
  History history(begin("M06 T101001\nG1 X10 F6000\nM02\n"));
  history.go_to_block(100);
  EXPECT_TRUE(history.present().has_ended());
  history.step_back();
  EXPECT_FALSE(history.present().has_ended());
  EXPECT_EQ(history.present().line(), 2u);
}

TEST_F(HistoryTest, FindsTheLastBlockBefore) {
  History history(begin("M06 T101001\nG1 X10 F6000\n\nX20\nX30\nM02\n"));
  history.go_to_block(100);
  const auto on_line = [](std::uint64_t line) {
    return [line](const running::Block& block) { return block.line + 1 == line; };
  };
  EXPECT_EQ(history.find_before(5, on_line(4)), 2u);
  EXPECT_EQ(history.find_before(2, on_line(4)), std::nullopt) << "only blocks before";
  EXPECT_EQ(history.find_before(100, [](const running::Block& block) { return !block.tree.is_empty(); }), 4u);
  EXPECT_EQ(history.find_before(0, [](const running::Block&) { return true; }), std::nullopt);
}

TEST_F(HistoryTest, FindsTheLastMotionBefore) {
  for (const std::uint64_t seed : seeds(25)) {
    Random random(seed);
    History history(begin(RandomRun(random).text(random.between(1, 4)), random.between(0, 2)), kFew);
    history.go_to_block(static_cast<std::uint64_t>(random.between(0, 200)));
    const auto leads_right = [](const kinematics::Move& move) { return move.to.tip.x() > move.from.tip.x() + 5; };
    std::vector<bool> does_block;
    for (Simulation fresh = fresh_before(0); !fresh.has_ended();) {
      does_block.push_back(false);
      fresh.trace_block(
          [&](const kinematics::Move& move) { does_block.back() = does_block.back() || leads_right(move); });
    }
    const std::uint64_t end = std::min<std::uint64_t>(history.present().blocks(), does_block.size());
    const auto from = static_cast<std::uint64_t>(random.between(0, static_cast<int>(end)));
    std::optional<std::uint64_t> last;
    for (std::uint64_t block = from; block < end; ++block)
      if (does_block[block]) last = block;
    const auto pass_block = [&](Simulation& simulation) {
      bool has_found = false;
      simulation.trace_block([&](const kinematics::Move& move) { has_found = has_found || leads_right(move); });
      return has_found;
    };
    EXPECT_EQ(history.find_simulated_before(end, pass_block, from), last) << seed;
  }
}

TEST_F(HistoryTest, FindsTheBlockOfAnEarlierLine) {
  for (const std::uint64_t seed : seeds(25)) {
    Random random(seed);
    History history(begin(RandomRun(random).text(random.between(1, 4)), random.between(0, 2)), kFew);
    const auto blocks = static_cast<std::uint64_t>(random.between(0, 200));
    history.go_to_block(blocks);
    const std::uint64_t end = history.present().runner().place().line;
    std::vector<std::optional<std::uint64_t>> block_of(end);
    for (running::Runner runner = fresh_before(0).runner(); !runner.has_ended(); runner.pass_empty_lines()) {
      if (runner.place().line < end) block_of[runner.place().line] = runner.result().blocks;
      runner.step();
    }
    history.go_to_block(static_cast<std::uint64_t>(random.between(0, 200)));
    for (std::uint64_t line = 0; line < end; ++line) EXPECT_EQ(history.find_line(line), block_of[line]) << seed;
  }
}

TEST_F(HistoryTest, SkipsToALineAndGoesOnAsAFreshRun) {
  for (const std::uint64_t seed : seeds(25)) {
    Random random(seed);
    History history(begin(RandomRun(random).text(random.between(1, 4))), kFew);
    history.go_to_block(static_cast<std::uint64_t>(random.between(0, 200)));
    history.go_to_block(static_cast<std::uint64_t>(random.between(0, 100)));
    const Simulation before = history.present();
    history.skip_to_line(static_cast<std::uint64_t>(random.between(0, 300)));
    EXPECT_GE(history.present().time(), before.time()) << seed;
    history.step_block();
    if (!history.present().has_ended()) {
      ASSERT_EQ(shown(history.present()), shown(fresh_before(history.present().blocks()))) << seed;
    }
    history.return_to(before);
    ASSERT_EQ(shown(history.present()), shown(before)) << seed;
  }
}

/// Set values are still there after a return, and the results of the old value are dropped.
TEST_F(HistoryTest, KeepsWhatHasBeenSet) {
  History history(
      begin("M06 T101001\nG1 X10 F6000\nIF VGPL=1 GOTO N5\nX20\nN5 X30\nV1=3\nIF V1=4 GOTO N6\nX1\nN6\nM02\n"));
  history.go_to_block(100);
  history.go_to_block(2);
  history.set_vgpl(1);
  history.step_block();
  EXPECT_EQ(history.present().line(), 4u);
  history.step_block();
  history.step_block();
  history.set_register(1, 4);
  history.step_block();
  EXPECT_EQ(history.present().line(), 9u);
  history.go_to_block(0);
  EXPECT_EQ(history.present().vgpl(), 0);
  history.go_to_block(100);
  EXPECT_TRUE(history.present().has_ended());
  EXPECT_EQ(history.present().blocks(), 7u);
  EXPECT_EQ(history.find_before(100, [](const running::Block& block) { return block.line == 3; }), std::nullopt);
  EXPECT_EQ(history.find_before(100, [](const running::Block& block) { return block.registers[1] == 4; }), 6u);
}

TEST_F(HistoryTest, HoldsAsMuchOfALongProgramAsOfAShortOne) {
  const auto after = [&](int lines) {
    std::string text = "M06 T101001\nG91 G1 X0.1 F6000\n";
    for (int i = 0; i < lines; ++i) text += i % 50 == 0 ? "X0.1 Y0.3\n" : "X0.1\n";
    History history(begin(text + "M02\n"), {.checkpoints = 20, .nearby = 4, .spacing = 64});
    history.go_to_block(static_cast<std::uint64_t>(lines));
    return history.memory();
  };
  EXPECT_LT(after(20'000), 2 * after(4'000));
}

/// Without copies, a return would repeat the whole run.
TEST_F(HistoryTest, KeepsCopiesWhereNothingTakesTime) {
  std::string text = "M06 T101001\n";
  for (int i = 0; i < 1'000; ++i) text += "V1=1\n";
  History history(begin(text + "M02\n"), {.nearby = 0, .spacing = 16});
  history.go_to_block(1'000);
  EXPECT_GT(history.memory(), 40 * sizeof(Simulation));
}

TEST_F(HistoryTest, HoldsNoMoreThanItsBytes) {
  std::string text = "M06 T101001\nG91 G1 X0.1 F6000\n";
  for (int i = 0; i < 4'000; ++i) text += "X0.1 Y0.01\n";
  constexpr std::size_t kBytes = 300'000;
  History history(begin(text + "M02\n"), {.bytes = kBytes, .nearby = 0, .spacing = 16});
  history.go_to_block(4'000);
  EXPECT_LT(history.memory(), kBytes);
  EXPECT_GT(history.memory(), kBytes / 4);
}

/// A moment reached by any steps, back or forward, is as in a new run.
TEST_F(HistoryTest, WalksAsAFreshRun) {
  for (const std::uint64_t seed : seeds(25)) {
    Random random(seed);
    History history(begin(RandomRun(random).text(random.between(1, 4)), random.between(0, 2), random.one_in(4)), kFew);
    Simulation end = fresh_before(1'000'000);
    for (int i = 0; i < 40; ++i) {
      const auto block = static_cast<std::uint64_t>(random.between(0, static_cast<int>(end.blocks()) + 1));
      switch (random.between(0, 3)) {
        case 0:
          history.go_to_block(block);
          ASSERT_EQ(shown(history.present()), shown(fresh_before(block))) << seed;
          break;
        case 1: {
          const std::uint64_t blocks = history.present().blocks();
          const bool was_stopped =
              history.present().has_ended() && history.present().run().ending == running::Ending::Error;
          history.step_back();
          const std::uint64_t before = was_stopped || blocks == 0 ? blocks : blocks - 1;
          ASSERT_EQ(shown(history.present()), shown(fresh_before(before))) << seed;
          break;
        }
        default:
          go_on(history, random, history.present().time());
          if (history.present().is_in_block()) break;
          if (history.present().has_ended()) {
            ASSERT_EQ(shown(history.present()), shown(end)) << seed;
          } else {
            ASSERT_EQ(shown(history.present()), shown(fresh_before(history.present().blocks()))) << seed;
          }
      }
    }
  }
}

TEST_F(HistoryTest, FindsWhatARunInOneGoFinds) {
  for (const std::uint64_t seed : seeds(25)) {
    Random random(seed);
    History history(begin(RandomRun(random).text(random.between(1, 4)), random.between(0, 2)), kFew);
    history.go_to_block(static_cast<std::uint64_t>(random.between(0, 200)));
    std::vector<std::uint64_t> lines;
    for (running::Runner runner = fresh_before(0).runner(); !runner.has_ended(); runner.pass_empty_lines()) {
      if (const auto block = runner.next()) lines.push_back(block->line);
      runner.step();
    }
    for (int i = 0; i < 10; ++i) {
      const auto before = static_cast<std::size_t>(random.between(0, static_cast<int>(lines.size())));
      const std::uint64_t divisor = static_cast<std::uint64_t>(random.between(1, 60));
      std::optional<std::uint64_t> expected;
      for (std::size_t block = 0; block < before; ++block)
        if (lines[block] % divisor == 0) expected = block;
      EXPECT_EQ(history.find_before(before, [&](const running::Block& block) { return block.line % divisor == 0; }),
                expected)
          << seed;
    }
  }
}

/// A value is set during the run, between steps back and forward.
TEST_F(HistoryTest, WalksAsAFreshRunInWhichTheSameIsSet) {
  for (const std::uint64_t seed : seeds(25)) {
    Random random(seed);
    History history(begin(RandomRun(random).text(random.between(1, 4))), kFew);
    const auto middle = static_cast<std::uint64_t>(random.between(0, 60));
    history.go_to_block(2 * middle);
    history.go_to_block(middle);
    if (history.present().has_ended()) continue;
    history.set_vgpl(2);
    for (int i = 0; i < 20; ++i) {
      const auto block = static_cast<std::uint64_t>(random.between(0, 150));
      history.go_to_block(block);
      ASSERT_EQ(shown(history.present()), shown(fresh_before(block, static_cast<int>(middle), 2))) << seed;
    }
  }
}

}  // namespace
}  // namespace isocnc::simulation
