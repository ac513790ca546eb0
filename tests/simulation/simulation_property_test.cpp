#include "interpreter/simulation/simulation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "simulation_case.h"
#include "tests/support/random_program.h"

namespace isocnc::simulation {
namespace {

using support::Random;
using support::seeds;

/// A new run from the start to the present moment of `other`.
Simulation fresh_at(const Case& of, const Simulation& other) {
  Simulation fresh = of.start();
  const std::uint64_t whole = other.blocks() - (other.is_in_block() ? 1 : 0);
  while (fresh.blocks() < whole) fresh.step_block();
  if (other.is_in_block()) fresh.advance_in_block(other.time());
  if (other.has_ended()) fresh.step_block();
  return fresh;
}

/// The result of an uninterrupted run, as in isorun.
struct Trip {
  explicit Trip(const Case& of)
      : timing(of.machine(), {.event =
                                  [this](const timing::TimedEvent& timed) {
                                    if (timed.move && timed.duration > 0) moves.push_back(*timed.move);
                                  },
                              .stretch =
                                  [this](const motion::Stretch& stretch, const timing::TimedEvent& timed) {
                                    stretches.emplace_back(stretch, timed.event.line);
                                  }}) {
    Compensation compensation(of.machine());
    const Compensation::Listeners to_timing{.event = [this](const running::Event& event) { timing.take(event); },
                                            .warning = [](const RunWarning&) {}};
    result = running::run(of.text(), of.options(),
                          [&](const running::Event& event) { compensation.take(event, to_timing); });
    compensation.finish(to_timing);
    timing.finish();
  }

  std::vector<std::pair<motion::Stretch, std::uint64_t>> stretches;  ///< Pairs of a stretch and its line.
  std::vector<kinematics::Move> moves;                               ///< The moves that take time.
  timing::Timing timing;
  running::RunResult result;
};

TEST(SimulationProperty, FollowsThePathOfARunInOneGo) {
  for (const std::uint64_t seed : seeds(40)) {
    Random random(seed);
    const Case some{random};
    const Trip trip(some);
    Simulation simulation = some.start();
    for (const auto& [stretch, line] : trip.stretches) {
      const double middle = stretch.start + stretch.duration / 2;
      if (middle <= stretch.start || middle >= stretch.start + stretch.duration)
        continue;  // A stretch too short to have a moment within it.
      advance_to(simulation, middle);
      const motion::Sample expected = stretch.at(some.machine().motion.kinematics, middle);
      ASSERT_EQ(simulation.sample().joints, expected.joints) << seed << " at " << middle;
      ASSERT_EQ(simulation.sample().tip.tip, expected.tip.tip) << seed << " at " << middle;
      ASSERT_EQ(simulation.sample().speed, expected.speed) << seed << " at " << middle;
      ASSERT_EQ(simulation.line(), line) << seed << " at " << middle;
    }
  }
}

/// Each block is run on a copy, as a debugger looks ahead.
TEST(SimulationProperty, TracesTheMotionsOfARunInOneGo) {
  for (const std::uint64_t seed : seeds(40)) {
    Random random(seed);
    const Case some{random};
    std::vector<kinematics::Move> moves;
    Simulation simulation = some.start();
    for (; !simulation.has_ended(); simulation.step_block())
      Simulation(simulation).trace_block([&](const kinematics::Move& move) { moves.push_back(move); });
    const Trip trip(some);
    ASSERT_EQ(moves.size(), trip.moves.size()) << seed;
    for (std::size_t i = 0; i < moves.size(); ++i) {
      EXPECT_EQ(moves[i].from.tip, trip.moves[i].from.tip) << seed << " motion " << i;
      EXPECT_EQ(moves[i].to.tip, trip.moves[i].to.tip) << seed << " motion " << i;
      EXPECT_EQ(moves[i].tool_length, trip.moves[i].tool_length) << seed << " motion " << i;
    }
  }
}

TEST(SimulationProperty, EndsAsARunInOneGo) {
  for (const std::uint64_t seed : seeds(40)) {
    Random random(seed);
    const Case some{random};
    const Trip trip(some);
    const timing::Timing& timing = trip.timing;
    const running::RunResult& result = trip.result;
    Simulation simulation = some.start();
    advance_to(simulation, 1e9);
    EXPECT_TRUE(simulation.has_ended());
    EXPECT_EQ(simulation.time(), timing.time()) << seed;
    EXPECT_EQ(simulation.run().state, result.state) << seed;
    EXPECT_EQ(simulation.run().ending, result.ending) << seed;
    EXPECT_EQ(simulation.blocks(), result.blocks) << seed;
    EXPECT_NEAR((simulation.sample().tip.tip - timing.tip().tip).norm(), 0, kTiny) << seed;
    EXPECT_NEAR((simulation.sample().joints - timing.joints()).norm(), 0, kTiny) << seed;
  }
}

/// After a stop at any moment, a copy continues exactly like the original, and both are in the state of a new run.
TEST(SimulationProperty, GoesOnAsTheOriginalAndAsAFreshRun) {
  for (const std::uint64_t seed : seeds(40)) {
    Random random(seed);
    const Case some{random};
    auto simulation = std::make_unique<Simulation>(some.start());
    while (!simulation->has_ended()) {
      go_on(*simulation, random, simulation->time());
      ASSERT_EQ(shown(*simulation), shown(fresh_at(some, *simulation))) << seed;
      if (!random.one_in(3)) continue;
      auto copy = std::make_unique<Simulation>(*simulation);
      ASSERT_EQ(shown(*copy), shown(*simulation)) << seed;
      Random same = random;
      for (int i = random.between(1, 4); i > 0; --i) {
        Random twin = same;
        go_on(*copy, same, copy->time());
        go_on(*simulation, twin, simulation->time());
        ASSERT_EQ(shown(*copy), shown(*simulation)) << seed;
      }
      simulation = std::move(copy);
    }
    const double end = simulation->time();
    simulation->step_block();
    advance_to(*simulation, 2 * end + 1);
    EXPECT_EQ(simulation->time(), end) << seed;
  }
}

/// A program with any errors ends as it does in an uninterrupted run.
TEST(SimulationProperty, RunsAnyProgram) {
  for (const std::uint64_t seed : seeds(60)) {
    Random random(seed);
    const Case some{fmt::format("{}\n", fmt::join(support::RandomProgram(random).lines(40), "\n")), 1,
                    random.one_in(2)};
    const running::RunResult result = running::run(some.text(), some.options(), [](const running::Event&) {});
    Simulation simulation = some.start();
    for (int i = 0; i < 100 && !simulation.has_ended(); ++i) simulation.step_block();
    ASSERT_TRUE(simulation.has_ended()) << seed;
    EXPECT_EQ(simulation.run().state, result.state) << seed;
    EXPECT_EQ(simulation.run().ending, result.ending) << seed;
    EXPECT_EQ(simulation.line(), result.line) << seed;
  }
}

/// The shown positions and speeds agree, without leaps, except that a tool change moves the tip.
TEST(SimulationProperty, MovesAtTheSpeedThatItShows) {
  constexpr double kStep = 0.002;
  constexpr double kMaxAcceleration = 30'000;  // The acceleration in mm/s^2 of a tip that B and C swing as well.
  for (const std::uint64_t seed : seeds(8)) {
    Random random(seed);
    const Case some{RandomRun(random).text(2), 1};
    Simulation simulation = some.start();
    motion::Sample last = simulation.sample();
    for (int step = 1; !simulation.has_ended(); ++step) {
      advance_to(simulation, step * kStep);
      const motion::Sample now = simulation.sample();
      const double tolerance = kMaxAcceleration * kStep * kStep + kTiny;
      const kinematics::Coordinates expected = kStep * (last.joint_speeds + now.joint_speeds) / 2;
      ASSERT_LE((now.joints - last.joints - expected).cwiseAbs().maxCoeff(), tolerance)
          << seed << " at " << simulation.time();
      if (last.speed > 0) {
        ASSERT_LE((now.tip.tip - last.tip.tip).norm(), kStep * (last.speed + now.speed) / 2 + tolerance)
            << seed << " at " << simulation.time();
      }
      last = now;
    }
  }
}

}  // namespace
}  // namespace isocnc::simulation
