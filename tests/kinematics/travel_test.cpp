#include "interpreter/kinematics/travel.h"

#include <gtest/gtest.h>

#include <array>
#include <numbers>
#include <random>

#include "interpreter/kinematics/kinematics.h"
#include "moves.h"
#include "tests/support/random.h"

namespace isocnc::kinematics {
namespace {

using geometry::Vec3;

Machine with_range(MachineAxis axis, double minimum, double maximum) {
  Machine machine = uniform_machine(100, 100);
  machine.axes[axis].minimum = minimum;
  machine.axes[axis].maximum = maximum;
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
    for (AxisLimits& axis : machine.axes) axis.minimum = axis.maximum = 1e-4;  // All else is outside.
    for (const Move& move : random_moves(11, static_cast<int>(support::often(60)))) {
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

geometry::Frame turned_frame() {
  geometry::Frame frame;
  frame.origin = {10, 20, 30};
  frame.axes = geometry::axes_from_angles(30, 40);
  frame.axes.col(2) = Vec3(1, 2, 5).normalized();  // Oblique, as frames may be.
  return frame;
}

/// Sampled along the programmed path, densely.
struct Sampled {
  double length = 0;
  std::array<geometry::Range, 3> extents;
};

Sampled sampled(const Machine& machine, const Move& move, const geometry::Frame& frame) {
  constexpr int kParts = 1'000;
  Sampled result;
  Vec3 last = move.from.tip;
  for (int i = 0; i <= kParts; ++i) {
    const Vec3 tip = programmed(machine, move, static_cast<double>(i) / kParts).tip;
    const Vec3 seen = frame.to_inner(tip);
    for (int axis = 0; axis < 3; ++axis) {
      geometry::Range& range = result.extents[static_cast<std::size_t>(axis)];
      if (i == 0) range = {seen[axis], seen[axis]};
      range.include({seen[axis], seen[axis]});
    }
    result.length += (tip - last).norm();
    last = tip;
  }
  return result;
}

TEST(TipTravel, IsThatOfTheProgrammedPath) {
  for (const Machine& machine : {three_axis_router(), head_router(), table_router()}) {
    for (const Move& move : random_moves(7, 20)) {
      for (const geometry::Frame& frame : {geometry::Frame{}, turned_frame()}) {
        const Sampled expected = sampled(machine, move, frame);
        EXPECT_NEAR(tip_travel(machine, move).length, expected.length, 1e-4 * (1 + expected.length))
            << "move " << move.tag;
        const auto extents = tip_extents(machine, move, frame);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          EXPECT_NEAR(extents[axis].minimum, expected.extents[axis].minimum, 1e-3) << "move " << move.tag;
          EXPECT_NEAR(extents[axis].maximum, expected.extents[axis].maximum, 1e-3) << "move " << move.tag;
        }
      }
    }
  }
}

/// A rapid that turns B by 90 degrees swings the tip away from both its ends, and back.
TEST(TipTravel, OfARapidThatTurnsIsTheSwing) {
  Machine machine = uniform_machine(100, 100);
  machine.kinematics.kind = MachineKind::Head;
  machine.kinematics.pivot = 200;
  Move move;
  move.to.b = 90;
  move.tool_length = 100;
  EXPECT_EQ(tip_travel(machine, move).length, 0) << "the tip is held";
  move.controls_tool_point = false;
  // Straight away from both ends by 300 (0.5 - sin 45) in X and in Z, and back.
  const double aside = 300 * (std::numbers::sqrt2 / 2 - 0.5) * std::numbers::sqrt2;
  EXPECT_GT(tip_travel(machine, move).length, 2 * aside);
  EXPECT_LT(tip_travel(machine, move).length, 2.2 * aside);
  EXPECT_LT(tip_extents(machine, move, {})[2].minimum, -300 * (std::numbers::sqrt2 / 2 - 0.5));
}

}  // namespace
}  // namespace isocnc::kinematics
