#include <gtest/gtest.h>

#include <map>

#include "debug_client.h"
#include "debugger/debuggee/debuggee.h"
#include "tests/simulation/random_run.h"

namespace isocnc::session {
namespace {

using simulation::Simulation;

bool are_equal(const Simulation& a, const Simulation& b) {
  const motion::Sample here = a.sample();
  const motion::Sample there = b.sample();
  return a.blocks() == b.blocks() && a.time() == b.time() && a.is_in_block() == b.is_in_block() &&
         a.line() == b.line() && a.has_ended() == b.has_ended() && a.run().state == b.run().state &&
         a.run().registers == b.run().registers && here.tip == there.tip && here.joints == there.joints &&
         a.to_go().path == b.to_go().path;
}

/// A fresh run to the same moment.
Simulation fresh_run_to(const Simulation& moment, const running::Program& program, const running::RunOptions& options,
                        const timing::TimedMachine& machine) {
  Simulation fresh(program, options, machine);
  const std::uint64_t whole = moment.blocks() - (moment.is_in_block() ? 1 : 0);
  while (!fresh.has_ended() && (fresh.blocks() < whole || fresh.is_in_block())) fresh.step_block();
  if (moment.is_in_block()) {
    fresh.step_instruction();
    fresh.advance_in_block(moment.time());
  }
  if (moment.has_ended() && !fresh.has_ended()) fresh.step_block();
  return fresh;
}

class Walks : public testing::TestWithParam<int> {};

TEST_P(Walks, EndWhereAFreshRunDoes) {
  support::Random random(static_cast<std::uint64_t>(GetParam()));
  const std::string text = simulation::RandomRun(random).text(3);
  const timing::TimedMachine machine = simulation::machine_of_tests();
  const running::RunOptions options = simulation::options_for(machine);
  const running::Program program(text);
  debuggee::Debuggee walker(debuggee::ProgramText(text), options, machine);
  for (int step = 0; step < 60; ++step) {
    switch (random.between(0, 5)) {
      case 0:
      case 1:
        walker.step_block();
        break;
      case 2:
        walker.step_instruction();
        break;
      case 3:
        walker.step_back();
        break;
      case 4:
        walker.step_instruction_back();
        break;
      default:
        walker.go_to_block(static_cast<std::uint64_t>(random.between(0, 40)));
    }
    ASSERT_TRUE(are_equal(walker.present(), fresh_run_to(walker.present(), program, options, machine)))
        << "step " << step << " of\n"
        << text;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, Walks, testing::Range(0, 25));

class ClientWalks : public testing::TestWithParam<int> {};

/// All that a client is shown between two blocks, however it has come there, is what it was on the first way on.
TEST_P(ClientWalks, ShowWhatTheFirstPassShowed) {
  support::Random random(static_cast<std::uint64_t>(GetParam()));
  std::string text = simulation::RandomRun(random).text(2);
  if (!text.ends_with("M02\n")) text += "M02\n";
  debugger::DebugClient client;
  client.stop_at_start(text);
  std::map<std::string, std::string> states;
  std::vector<int> lines;
  const auto any_line = [&] {
    return lines[static_cast<std::size_t>(random.between(0, static_cast<int>(lines.size()) - 1))];
  };
  const auto is_at_end = [&] {
    return client.request("stackTrace", {{"threadId", 1}}).at("stackFrames").at(0).at("name") == "M02";
  };
  const auto note = [&] {
    const std::string blocks = client.variable("Times", "Blocks executed");
    const auto [state, is_new] = states.emplace(blocks, client.state());
    if (is_new) lines.push_back(client.line());
    EXPECT_EQ(client.state(), state->second) << blocks << " blocks of\n" << text;
  };
  const auto go_on = [&] {
    if (is_at_end()) return false;
    if (client.run("next").at("reason") != "exception") return true;
    client.run("stepBack");
    return false;
  };
  do note();
  while (go_on());
  for (int step = 0; step < 25; ++step) {
    switch (random.between(0, 4)) {
      case 0:
        client.run("stepBack");
        break;
      case 1:
        go_on();
        break;
      case 2:
        client.run("stepBack");
        client.run("stepIn");
        client.run("stepBack", {{"granularity", "instruction"}});
        break;
      case 3: {
        client.set_lines({any_line()});
        client.run("reverseContinue");
        client.set_lines({});
        break;
      }
      default:
        client.run("goto", {{"threadId", 1}, {"targetId", any_line() - 1}});
    }
    note();
    if (HasFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, ClientWalks, testing::Range(0, 8));

TEST(ByHand, WhatIsUndoneLeavesNoTrace) {
  int undone = 0;
  for (int seed = 0; seed < 10; ++seed) {
    support::Random random(static_cast<std::uint64_t>(seed));
    const std::string text = simulation::RandomRun(random).text(2);
    const timing::TimedMachine machine = simulation::machine_of_tests();
    debuggee::Debuggee walker(debuggee::ProgramText(text), simulation::options_for(machine), machine);
    for (int i = random.between(1, 20); i > 0; --i) walker.step_block();
    if (walker.hindrance()) continue;
    const Simulation before = walker.present();
    ASSERT_FALSE(walker.run_by_hand("G90\nG00 X5 Y7\nG91\n").error);
    EXPECT_FALSE(are_equal(before, walker.present()));
    walker.step_block();
    walker.go_to_block(before.blocks());
    walker.step_back();
    EXPECT_TRUE(are_equal(before, walker.present())) << seed;
    ++undone;
  }
  EXPECT_GT(undone, 3);
}

}  // namespace
}  // namespace isocnc::session
