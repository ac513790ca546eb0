#include <gtest/gtest.h>

#include "tests/motion/programs.h"
#include "tests/motion/reference.h"

namespace isocnc::motion {
namespace {

/// The planner's time over the reference's.
double ratio(const Machine& machine, const std::vector<Move>& moves, int steps) {
  const auto stretches = plan(machine, moves);
  return cycle_time(stretches) / reference_time(machine, moves, stretches, steps);
}

TEST(Optimality, LinesAreTheOptimum) {
  Machine machine = three_axis_router();
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    std::vector<Move> lines;
    geometry::Pose at;
    for (Move move : random_moves(seed, 30)) {
      if (move.is_arc) continue;
      const geometry::Vec3 way = move.to.tip - move.from.tip;
      move.from = move.to = at;
      move.to.tip += way;
      move.tag = lines.size();
      lines.push_back(move);
      at = move.to;
    }
    // The grid of the reference is too coarse to profit from every meter.
    const double coarse = ratio(machine, lines, 100);
    const double fine = ratio(machine, lines, 1600);
    EXPECT_LE(fine, 1 + 1e-4) << seed;
    EXPECT_GE(fine, 0.999) << seed;
    EXPECT_GE(fine, coarse - 1e-9) << seed << ": the reference comes down to the planner";
  }
}

TEST(Optimality, AnyMovesAreWithinAPercent) {
  for (const Machine& machine : {three_axis_router(), head_router(), table_router()}) {
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      const double found = ratio(machine, random_moves(seed, 15), 200);
      EXPECT_LE(found, 1.01) << seed;
      EXPECT_GE(found, 0.995) << seed;
    }
  }
}

/// Where the centripetal acceleration leaves little for speeding up, the bounds by pieces cost the most.
TEST(Optimality, FastCirclesAreWithinAPercent) {
  const Machine machine = uniform_machine(10000, 2000);
  for (const double feed : {50.0, 200.0, 10000.0}) {
    const double found = ratio(machine, {arc_xy({-20, 0, 0}, {0, 0, 0}, 360, 0, speed(feed))}, 50);
    EXPECT_LE(found, 1.01) << feed;
    EXPECT_GE(found, 0.9999) << feed;
  }
}

/// Five axes at once: the pivot's swing takes nearly all.
TEST(Optimality, SwingingPivotsAreWithinAPercent) {
  Machine machine = uniform_machine(400, 2000);
  machine.kinematics = {.kind = MachineKind::Head, .pivot = 200, .b_from_c = {30, 0, 0}};
  Move move = line({0, 0, 0}, {60, 10, 0}, speed(300));
  move.from.b = 70;
  move.to.b = -20;
  move.to.c = 120;
  move.tool_length = 100;
  const double found = ratio(machine, {move}, 100);
  EXPECT_LE(found, 1.015);
  EXPECT_GE(found, 0.9999);
}

}  // namespace
}  // namespace isocnc::motion
