#include "interpreter/kinematics/independent_rapid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "interpreter/kinematics/travel.h"
#include "tests/motion/programs.h"
#include "tests/support/random.h"

namespace isocnc::motion {
namespace {

using geometry::Pose;
using geometry::Vec3;
using kinematics::Coordinates;
using kinematics::Machine;
using kinematics::Move;

Machine independent(Machine machine) {
  machine.rapid_motion = kinematics::RapidMotion::Independent;
  return machine;
}

Move rapid(const Pose& from, const Pose& to, double tool_length = 0) {
  Move move;
  move.from = from;
  move.to = to;
  move.controls_tool_point = false;
  move.tool_length = tool_length;
  return move;
}

Move random_rapid(support::Random& random, bool turns) {
  const auto pose = [&] {
    Pose pose{Vec3(random.real(-500, 500), random.real(-400, 400), random.real(-100, 100)), 0, 0};
    if (turns) pose.b = random.real(-90, 90);
    if (turns) pose.c = random.real(-300, 300);
    return pose;
  };
  Move move = rapid(pose(), pose(), random.real(0, 200));
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    if (random.one_in(4)) move.to.tip[axis] = move.from.tip[axis];
  if (random.one_in(4)) move.to.tip = move.from.tip + 1e-3 * (move.to.tip - move.from.tip);
  return move;
}

std::optional<Sample> sample_at(const Machine& machine, const std::vector<Stretch>& stretches, double time) {
  for (const Stretch& stretch : stretches)
    if (time <= stretch.start + stretch.duration) return stretch.at(machine.kinematics, time);
  if (stretches.empty()) return std::nullopt;
  return stretches.back().at(machine.kinematics, time);
}

/// Without limits of jerk: one axis moves as a machine does that has no other one.
TEST(IndependentRapid, EachJointMovesAsIfAlone) {
  support::Random random(1);
  for (const Machine& each : {kinematics::three_axis_router(), kinematics::head_router(), kinematics::table_router()}) {
    const Machine machine = independent(each);
    for (int i = 0; i < 60; ++i) {
      const Move move = random_rapid(random, i % 2 == 0);
      const std::vector<Stretch> stretches = plan(machine, {move});
      const auto joints = [&](const Pose& pose) {
        return kinematics::inverse(machine.kinematics, kinematics::coordinates(pose), move.tool_length);
      };
      double longest = 0;
      for (std::size_t axis = 0; axis < machine.axes.size(); ++axis) {
        const auto index = static_cast<Eigen::Index>(axis);
        const double from = joints(move.from)[index];
        const double way = joints(move.to)[index] - from;
        if (std::abs(way) < 1e-8) continue;
        Machine alone = kinematics::three_axis_router();
        alone.axes[kinematics::kX] = machine.axes[axis];
        const std::vector<Stretch> expected = plan(alone, {line(Vec3::Zero(), Vec3(way, 0, 0), kRapid)});
        longest = std::max(longest, cycle_time(expected));
        for (int k = 0; k <= 50; ++k) {
          const double time = cycle_time(expected) * k / 40;
          const std::optional<Sample> sample = sample_at(machine, stretches, time);
          ASSERT_TRUE(sample);
          EXPECT_NEAR(sample->joints[index] - from, sample_at(alone, expected, time)->joints[kinematics::kX], 1e-7);
        }
      }
      EXPECT_NEAR(cycle_time(stretches), longest, 1e-9);
    }
  }
}

/// It ends at rest, so nothing that follows can change it.
TEST(IndependentRapid, ComesOutAtOnce) {
  const Machine router = kinematics::three_axis_router();
  for (const Machine& machine : {independent(router), independent(with_jerk(router, 40000))}) {
    Planner planner(machine);
    planner.push(rapid({}, {Vec3(300, 80, 0), 0, 0}));
    bool ends = false;
    while (const Stretch* const stretch = planner.next()) ends = stretch->ends_move;
    EXPECT_TRUE(ends);
  }
}

/// From rest to v it takes v/a + a/j, or 2 sqrt(v/j) where a is not reached.
TEST(IndependentRapid, JerkLimitsEachJoint) {
  Machine machine = independent(kinematics::three_axis_router());
  for (kinematics::AxisLimits& axis : machine.axes) axis.speed = 500, axis.acceleration = 2000, axis.jerk = 20000;
  const auto time = [&](double way) { return cycle_time(plan(machine, {rapid({}, {Vec3(way, 0, 0), 0, 0})})); };
  EXPECT_NEAR(time(1000), 1000 / 500.0 + 500 / 2000.0 + 2000 / 20000.0, 1e-9);
  const double speed = (std::sqrt(200 * 200 + 4 * 2000 * 50) - 200) / 2;  // v^2/a + v a/j = 50.
  EXPECT_NEAR(time(50), 2 * (speed / 2000 + 0.1), 1e-9);
  EXPECT_NEAR(time(1), 4 * std::cbrt(1 / (2 * 20000.0)), 1e-9);
  machine.axes[kinematics::kX].acceleration = 1e6;  // The speed is reached, the acceleration is not.
  EXPECT_NEAR(time(1000), 1000 / 500.0 + 2 * std::sqrt(500 / 20000.0), 1e-9);
}

TEST(IndependentRapid, KeepsAllLimits) {
  support::Random random(2);
  for (const Machine& each : {kinematics::three_axis_router(), kinematics::head_router(), kinematics::table_router()}) {
    const Machine machine = independent(with_jerk(each, 40000));
    for (int i = 0; i < 40; ++i) {
      const Move move = random_rapid(random, i % 2 == 0);
      const std::vector<Stretch> stretches = plan(machine, {move});
      const double end = cycle_time(stretches);
      constexpr int kSteps = 2000;
      Coordinates last = Coordinates::Zero();
      for (int k = 0; k <= kSteps; ++k) {
        const std::optional<Sample> sample = sample_at(machine, stretches, end * k / kSteps);
        if (!sample) break;
        for (std::size_t axis = 0; axis < machine.axes.size(); ++axis) {
          const auto index = static_cast<Eigen::Index>(axis);
          const kinematics::AxisLimits& limits = machine.axes[axis];
          EXPECT_LE(std::abs(sample->joint_speeds[index]), limits.speed * (1 + 1e-9));
          EXPECT_LE(std::abs(sample->joint_accelerations[index]), limits.acceleration * (1 + 1e-6));
          EXPECT_LE(std::abs(sample->joint_accelerations[index] - last[index]),
                    *limits.jerk * end / kSteps * 1.001 + 1e-6);
        }
        last = sample->joint_accelerations;
      }
      if (stretches.empty()) continue;
      const Sample arrived = stretches.back().at(machine.kinematics, end);
      EXPECT_LE((arrived.tip.tip - move.to.tip).norm(), 1e-7);
      EXPECT_LE(arrived.joint_speeds.norm(), 1e-5);
    }
  }
}

/// All others are as they were, but from rest to rest.
TEST(IndependentRapid, StartsAndEndsAtRest) {
  for (const Machine& each : {uniform_machine(1000, 2000), with_jerk(uniform_machine(1000, 2000), 40000)}) {
    const Machine machine = independent(each);
    std::vector<Move> moves = {line({0, 0, 0}, {40, 0, 0}, speed(100)), rapid({{40, 0, 0}, 0, 0}, {{70, 10, 0}, 0, 0}),
                               line({70, 10, 0}, {90, 10, 0}, speed(100))};
    for (std::size_t i = 0; i < moves.size(); ++i) moves[i].tag = i;
    const std::vector<Stretch> stretches = plan(machine, moves);
    double apart = 0;
    for (const Move& move : moves) apart += cycle_time(plan(machine, {move}));
    EXPECT_NEAR(cycle_time(stretches), apart, 1e-9);
    std::vector<std::uint64_t> ended;
    double time = 0;
    for (const Stretch& stretch : stretches) {
      EXPECT_NEAR(stretch.start, time, 1e-12);
      time = stretch.start + stretch.duration;
      if (stretch.ends_move) ended.push_back(stretch.tag);
    }
    EXPECT_EQ(ended, (std::vector<std::uint64_t>{0, 1, 2}));
    EXPECT_EQ(plan(machine, {rapid({{1, 2, 3}, 0, 0}, {{1, 2, 3}, 0, 0})}).size(), 0u);
  }
}

/// Two axes with the same limits: at 45 degrees until the shorter one slows down.
TEST(IndependentRapid, BendsWhereTheShorterWayEnds) {
  const Machine machine = independent(uniform_machine(1000, 2000));
  const Move move = rapid({}, {{1000, 600, 0}, 0, 0});
  const std::vector<Stretch> stretches = plan(machine, {move});
  EXPECT_NEAR(cycle_time(stretches), 1000 / 1000.0 + 0.5, 1e-9);
  const auto tip = [&](double time) { return sample_at(machine, stretches, time)->tip.tip; };
  EXPECT_NEAR((tip(0.6) - Vec3(350, 350, 0)).norm(), 0, 1e-9);
  EXPECT_NEAR((tip(1.1) - Vec3(840, 600, 0)).norm(), 0, 1e-9) << "X slows down since 1.0 s, where it was at 750";
  EXPECT_FALSE(kinematics::leaves_line(machine, rapid({}, {{0, 600, 0}, 0, 0})));
  EXPECT_FALSE(kinematics::leaves_line(uniform_machine(1000, 2000), move));
  Move feed = move;
  feed.feed = speed(1000);
  feed.controls_tool_point = true;
  EXPECT_FALSE(kinematics::leaves_line(machine, feed));
}

TEST(IndependentRapid, LengthAndExtentsAreThoseOfTheTipsPath) {
  support::Random random(3);
  for (const Machine& each : {kinematics::three_axis_router(), kinematics::head_router(), kinematics::table_router()}) {
    const Machine machine = independent(each);
    for (int i = 0; i < 30; ++i) {
      Move move = random_rapid(random, i % 3 == 0);
      if (i % 3 == 1) move.from.b = move.to.b = 40;  // A tilted table leads the tip across.
      const std::vector<Stretch> stretches = plan(machine, {move});
      if (stretches.empty()) continue;
      constexpr int kSteps = 20'000;
      double length = 0;
      Vec3 low = move.from.tip;
      Vec3 high = low;
      Vec3 last = low;
      std::size_t at = 0;
      for (int k = 1; k <= kSteps; ++k) {
        const double time = cycle_time(stretches) * k / kSteps;
        while (at + 1 < stretches.size() && time > stretches[at].start + stretches[at].duration) ++at;
        const Vec3 tip = stretches[at].at(machine.kinematics, time).tip.tip;
        length += (tip - last).norm();
        low = low.cwiseMin(tip);
        high = high.cwiseMax(tip);
        last = tip;
      }
      const kinematics::TipTravel travel = kinematics::tip_travel(machine, move);
      EXPECT_NEAR(travel.length, length, 1e-5 * (1 + length));
      for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(travel.extents[axis].minimum, low[static_cast<Eigen::Index>(axis)], 1e-2);
        EXPECT_NEAR(travel.extents[axis].maximum, high[static_cast<Eigen::Index>(axis)], 1e-2);
        EXPECT_LE(travel.extents[axis].minimum, low[static_cast<Eigen::Index>(axis)] + 1e-6);
        EXPECT_GE(travel.extents[axis].maximum, high[static_cast<Eigen::Index>(axis)] - 1e-6);
      }
    }
  }
}

/// A tip that nearly stops while the head turns: the length by many steps.
TEST(IndependentRapid, LengthIsThatOfATipThatNearlyStops) {
  Machine machine = independent(kinematics::head_router());
  for (const kinematics::MachineAxis axis : {kinematics::kX, kinematics::kZ}) machine.axes[axis].acceleration = 3000;
  machine.axes[kinematics::kB].speed = 10;
  machine.axes[kinematics::kB].acceleration = 100'000;
  const Move move = rapid({{0, 0, -100}, 0, 0}, {{317, 0, -100 - 100}, 13, 0}, 100);
  double length = 0;
  for (const kinematics::RapidPart& part : kinematics::independent_rapid(machine, move)) {
    constexpr int kSteps = 200'000;
    Vec3 last = part.path.tip_at(machine.kinematics, 0).value.head<3>();
    for (int i = 1; i <= kSteps; ++i) {
      const Vec3 tip = part.path.tip_at(machine.kinematics, part.length * i / kSteps).value.head<3>();
      length += (tip - last).norm();
      last = tip;
    }
  }
  EXPECT_NEAR(kinematics::tip_travel(machine, move).length, length, 1e-5);
}

TEST(IndependentRapid, ManyTakeNoMemory) {
  for (const Machine& each : {uniform_machine(1000, 2000), with_jerk(uniform_machine(1000, 2000), 40000)}) {
    Planner planner(independent(each));
    std::size_t most = 0;
    for (int i = 0; i < 20'000; ++i) {
      planner.push(i % 2 == 0 ? rapid({}, {{30, 10, 2}, 0, 0}) : rapid({{30, 10, 2}, 0, 0}, {}));
      while (planner.next()) continue;
      most = std::max(most, planner.memory());
    }
    EXPECT_LT(most, 2'000'000u);
  }
}

}  // namespace
}  // namespace isocnc::motion
