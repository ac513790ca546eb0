#include <gtest/gtest.h>

#include "tests/motion/jerk_limited_reference.h"
#include "tests/motion/programs.h"
#include "tests/motion/reference.h"
#include "tests/support/random.h"

namespace isocnc::motion {
namespace {

/// The planner's time over the reference's.
double ratio(const kinematics::Machine& machine, const std::vector<kinematics::Move>& moves, int steps) {
  const auto stretches = plan(machine, moves);
  return cycle_time(stretches) / reference_time(machine, moves, stretches, steps);
}

TEST(Optimality, LinesAreTheOptimum) {
  kinematics::Machine machine = kinematics::three_axis_router();
  for (const std::uint64_t seed : support::seeds(10)) {
    std::vector<kinematics::Move> lines;
    geometry::Pose at;
    for (kinematics::Move move : random_moves(seed, 30)) {
      if (move.is_arc) continue;
      const geometry::Vec3 way = move.to.tip - move.from.tip;
      move.from = move.to = at;
      move.to.tip += way;
      move.tag = lines.size();
      lines.push_back(move);
      at = move.to;
    }
    // The grid of the reference is too coarse to profit from every meter.
    const double coarse = ratio(machine, lines, 40);
    const double fine = ratio(machine, lines, 600);
    EXPECT_LE(fine, 1 + 1e-4) << seed;
    EXPECT_GE(fine, 0.999) << seed;
    EXPECT_GE(fine, coarse - 1e-9) << seed << ": the reference comes down to the planner";
  }
}

TEST(Optimality, AnyMovesAreWithinAPercent) {
  for (const kinematics::Machine& machine :
       {kinematics::three_axis_router(), kinematics::head_router(), kinematics::table_router()}) {
    for (const std::uint64_t seed : support::seeds(8)) {
      const double found = ratio(machine, random_moves(seed, 15), 100);
      EXPECT_LE(found, 1.01) << seed;
      EXPECT_GE(found, 0.995) << seed;
    }
  }
}

/// Where the centripetal acceleration leaves little for speeding up, the bounds by pieces cost the most.
TEST(Optimality, FastCirclesAreWithinAPercent) {
  const kinematics::Machine machine = uniform_machine(10000, 2000);
  for (const double feed : {50.0, 200.0, 10000.0}) {
    const double found = ratio(machine, {arc_xy({-20, 0, 0}, {0, 0, 0}, 360, 0, speed(feed))}, 50);
    EXPECT_LE(found, 1.01) << feed;
    EXPECT_GE(found, 0.9999) << feed;
  }
}

/// docs/motion.md, from rest to rest: the shorter the arc, the more of it is spent on speeding up and slowing down.
TEST(Optimality, FastArcsLoseNoMoreThanIsSaid) {
  constexpr std::pair<double, double> kSweeps[] = {{360, 1.006}, {90, 1.007}, {45, 1.018}};
  for (const kinematics::Machine& machine : {uniform_machine(10000, 2000), kinematics::three_axis_router()})
    for (const auto& [sweep, maximum] : kSweeps) {
      const double found = ratio(machine, {arc_xy({-20, 0, 0}, {0, 0, 0}, sweep, 0, speed(10000))}, 200);
      EXPECT_LE(found, maximum) << sweep;
      EXPECT_GE(found, 0.9999) << sweep;
    }
}

/// Five axes at once: the pivot's swing takes nearly all.
TEST(Optimality, SwingingPivotsAreWithinAPercent) {
  kinematics::Machine machine = uniform_machine(400, 2000);
  machine.kinematics = {.kind = kinematics::MachineKind::Head, .pivot = 200, .b_from_c = {30, 0, 0}};
  kinematics::Move move = line({0, 0, 0}, {60, 10, 0}, speed(300));
  move.from.b = 70;
  move.to.b = -20;
  move.to.c = 120;
  move.tool_length = 100;
  const double found = ratio(machine, {move}, 100);
  EXPECT_LE(found, 1.015);
  EXPECT_GE(found, 0.9999);
}

/// Chains of short lines that turn B and C, as of a finished surface: nearly all of their time is spent in corners.
TEST(Optimality, ShortLinesInFiveAxesAreWithinAPercent) {
  for (const kinematics::Machine& machine : {kinematics::head_router(), kinematics::table_router()}) {
    for (const std::uint64_t seed : support::seeds(6)) {
      support::Random random(seed);
      const double feed = random.real(10, 400);
      std::vector<kinematics::Move> moves;
      geometry::Pose at;
      for (std::uint64_t tag = 0; tag < 30; ++tag) {
        kinematics::Move move{.tag = tag, .from = at, .to = at, .feed = speed(feed), .tool_length = 100};
        move.to.tip += geometry::Vec3(random.real(0.2, 1), random.real(-0.5, 0.5), random.real(-0.2, 0.2));
        move.to.b += random.real(-0.5, 0.5);
        move.to.c += random.real(-0.5, 0.5);
        moves.push_back(move);
        at = move.to;
      }
      const double found = ratio(machine, moves, 60);
      EXPECT_LE(found, 1.01) << seed;
      EXPECT_GE(found, 0.995) << seed;
    }
  }
}

/// The planner's time over that of the ascent, where jerk is limited. The path is the planner's.
double jerk_limited_ratio(const kinematics::Machine& machine, const std::vector<kinematics::Move>& moves) {
  const auto stretches = plan(machine, moves);
  return cycle_time(stretches) / jerk_limited_reference_time(machine, moves[0].feed.value, stretches, 400);
}

TEST(Optimality, JerkLimitedLinesAreTheOptimum) {
  const kinematics::Machine machine = with_jerk(uniform_machine(1000, 2000), 20000);
  for (const double feed : {50.0, 150.0, 400.0}) {
    const double found = jerk_limited_ratio(machine, {line({0, 0, 0}, {60, 0, 0}, speed(feed))});
    EXPECT_LE(found, 1.03) << feed;
    EXPECT_GE(found, 0.94) << feed << ": the grid is too coarse";
  }
}

/// What the planner loses; docs/motion.md says why. On a circle it has to leave a good part of the jerk unused.
TEST(Optimality, JerkLimitedCornersAndArcsLoseNoMoreThanIsSaid) {
  const kinematics::Machine machine = with_jerk(uniform_machine(1000, 2000), 20000);
  const std::pair<std::vector<kinematics::Move>, double> programs[] = {
      {{line({0, 0, 0}, {20, 0, 0}, speed(100)), line({20, 0, 0}, {20, 20, 0}, speed(100))}, 1.08},
      {{line({-50, 0, 0}, {0, 0, 0}, speed(150)), arc_xy({0, 0, 0}, {0, 8, 0}, 90, 0, speed(150)),
        line({8, 8, 0}, {8, 60, 0}, speed(150))},
       1.16},
      {{arc_xy({-20, 0, 0}, {0, 0, 0}, 360, 0, speed(300))}, 1.42}};
  for (const auto& [moves, maximum] : programs) {
    const double found = jerk_limited_ratio(machine, moves);
    EXPECT_LE(found, maximum) << moves.size();
    EXPECT_GE(found, 0.97) << moves.size();
  }
}

}  // namespace
}  // namespace isocnc::motion
