#include "interpreter/motion/travel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/motion/programs.h"

namespace isocnc::motion {
namespace {

using geometry::Vec3;

Machine with_range(Axis axis, double least, double most) {
  Machine machine = uniform_machine(100, 100);
  machine.axes[axis].least = least;
  machine.axes[axis].most = most;
  return machine;
}

TEST(Travel, LinesLeaveTheRangeAtTheirEnds) {
  const Move move = line({0, 0, 0}, {100, 0, 0}, kRapid);
  EXPECT_TRUE(overtravels(with_range(kX, 0, 100), move).empty());
  const auto found = overtravels(with_range(kX, 1, 90), move);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].axis, kX);
  EXPECT_EQ(found[0].part, 0);
  EXPECT_EQ(found[0].limit, 1);
  EXPECT_EQ(found[1].part, 1);
  EXPECT_NEAR(found[1].position, 100, 1e-9);
}

TEST(Travel, ArcsBulge) {
  // From (-10, 0) over (0, 10) to (10, 0).
  const Move move = arc_xy({-10, 0, 0}, {0, 0, 0}, -180, 0, speed(10));
  const auto found = overtravels(with_range(kY, -1, 8), move);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].axis, kY);
  EXPECT_NEAR(found[0].part, 0.5, 1e-6);
  EXPECT_NEAR(found[0].position, 10, 1e-9);
  EXPECT_TRUE(overtravels(with_range(kY, -1, 10.001), move).empty());
}

/// The tip rests, and so do the ends: only the swing of the pivot between them leaves the range.
TEST(Travel, ThePivotSwings) {
  Machine machine = with_range(kZ, -1000, 99);
  machine.kinematics.kind = MachineKind::Head;
  machine.kinematics.pivot = 200;
  Move move;
  move.from.b = -60;
  move.to.b = 60;
  move.tool_length = 100;
  const auto found = overtravels(machine, move);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].part, 0.5, 1e-6);
  EXPECT_NEAR(found[0].position, 100, 1e-9);
  move.controls_tool_point = false;
  EXPECT_TRUE(overtravels(machine, move).empty());
}

TEST(Travel, RotaryAxesHaveRangesToo) {
  Move move;
  move.to.c = 400;
  const auto found = overtravels(head_router(), move);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].axis, kC);
  EXPECT_EQ(found[0].position, 400);
}

/// As far as a walk along the way in many small steps finds, and a little farther.
TEST(Travel, FindsTheFarthestPoint) {
  for (Machine machine : {three_axis_router(), head_router(), table_router()}) {
    for (AxisLimits& axis : machine.axes) axis.least = axis.most = 1e-4;  // All else is outside.
    for (const Move& move : random_moves(11, 60)) {
      const auto found = overtravels(machine, move);
      for (const Overtravel& each : found) {
        const double sign = each.position > each.limit ? 1 : -1;
        double farthest = -std::numeric_limits<double>::infinity();
        for (int i = 0; i <= 3000; ++i) {
          const geometry::Pose tip = programmed(machine, move, i / 3000.0);
          farthest =
              std::max(farthest, sign * inverse(machine.kinematics, coordinates(tip), move.tool_length)[each.axis]);
        }
        EXPECT_GE(sign * each.position, farthest - 1e-9) << each.axis;
        EXPECT_NEAR(sign * each.position, farthest, 2e-3) << each.axis;
      }
    }
  }
}

}  // namespace
}  // namespace isocnc::motion
