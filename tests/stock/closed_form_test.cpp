#include <gtest/gtest.h>

#include "cuts.h"

/// Removed volumes that have a closed form.
namespace isocnc::stock::cuts {
namespace {

/// The relative error of what sweeps remove.
double error_of(const Stock& stock, const std::vector<Sweep>& sweeps, double expected) {
  return removed(stock, sweeps) / expected - 1;
}

TEST(ClosedForm, StadiumSlotAtEightAngles) {
  const RevolvedBody tool = flat(10);
  for (const auto& [spacing, limit] : {std::pair(0.5, 0.003), std::pair(0.1, 0.0003)}) {
    const Stock stock(box({0, 0, -20}, {240, 240, 0}), spacing);
    double sum = 0;
    for (int i = 0; i < 8; ++i) {
      const double angle = i * pi / 16 + 0.05;
      const Vec3 from(17.3, 21.1, -5);
      const Vec3 to = from + 200 * Vec3(std::cos(angle), std::sin(angle), 0);
      const double error = error_of(stock, {line(tool, from, to)}, (100 * pi + 20 * 200) * 5);
      EXPECT_LE(std::abs(error), limit) << spacing << " mm, angle " << angle;
      sum += error;
    }
    EXPECT_LE(std::abs(sum / 8), limit / 3) << spacing << " mm";
  }
}

TEST(ClosedForm, SlotAlongTheGridIsAsWideAsTheTool) {
  const RevolvedBody tool = flat(10);
  const Stock stock(block(), 0.5);
  for (const double y : {0.0, 0.1, 0.25, 0.5})  // 0.25: both walls pass through dexels.
    EXPECT_NEAR(error_of(stock, {line(tool, {-300, y, -5}, {300, y, -5})}, 400 * 20 * 5), 0, 1e-6) << y;
}

TEST(ClosedForm, BallSlot) {
  const RevolvedBody tool = ball(6);
  const Stock stock(block(), 0.5);
  const double depth = 9;
  const double ends = 2.0 / 3 * pi * 216 + pi * 36 * (depth - 6);
  const double middle = 100 * (pi * 36 / 2 + 12 * (depth - 6));
  EXPECT_NEAR(error_of(stock, {line(tool, {-50.1, 3.3, -depth}, {49.9, 3.3, -depth})}, ends + middle), 0, 0.002);
}

TEST(ClosedForm, GrooveOfAConicalCutter) {
  const RevolvedBody tool = body(solids::cone_body(20, 0, 90, 60));
  const Stock stock(block(), 0.5);
  // A triangle along the line, and a cone at its ends.
  EXPECT_NEAR(error_of(stock, {line(tool, {-50, 0.1, -8}, {50, 0.1, -8})}, 64 * 100 + pi * 512 / 3), 0, 0.003);
}

TEST(ClosedForm, Plunges) {
  const Stock stock(block(), 0.25);
  EXPECT_NEAR(error_of(stock, {line(flat(10), {3.1, 4.2, 5}, {3.1, 4.2, -30})}, pi * 100 * 30), 0, 0.002);
  EXPECT_NEAR(error_of(stock, {line(ball(10), {3.1, 4.2, 5}, {3.1, 4.2, -30})}, pi * 100 * 20 + 2.0 / 3 * pi * 1000), 0,
              0.002);
  const RevolvedBody drill = body(solids::drill_body(10, 118, 60));
  const double tip = 10 / std::tan(59 * pi / 180);
  EXPECT_NEAR(error_of(stock, {line(drill, {3.1, 4.2, 5}, {3.1, 4.2, -30})}, pi * 100 * (30 - tip * 2 / 3)), 0, 0.002);
  // A bull nose: the flat disc, the half ring around it, and the cylinder.
  const RevolvedBody bull = body(solids::bull_body(10, 3, 60));
  const double edge = pi * 49 * 3 + pi * pi * 9 / 2 * 7 + 2.0 / 3 * pi * 27;
  EXPECT_NEAR(error_of(stock, {line(bull, {3.1, 4.2, 5}, {3.1, 4.2, -30})}, pi * 100 * 27 + edge), 0, 0.002);
}

TEST(ClosedForm, CircularSlotAndHelicalBore) {
  const RevolvedBody tool = flat(5);
  const Stock stock(block(), 0.25);
  const Vec3 start(20, 0, -5);
  for (const double degrees : {360.0, -360.0})
    EXPECT_NEAR(error_of(stock, {arc(tool, start, start, {0, 0, -5}, degrees)}, 4 * pi * 20 * 5 * 5), 0, 0.002);
  // A quarter of it, with the tool's own disc half at each end.
  EXPECT_NEAR(error_of(stock, {arc(tool, start, {0, 20, -5}, {0, 0, -5}, 90)}, (pi * 20 * 5 + pi * 25) * 5), 0, 0.002);

  std::vector<Sweep> bore;
  const Vec3 center(0.3, 0.7, 0);
  const auto at = [&](double z) { return Vec3(center + Vec3(4, 0, z)); };
  for (int turn = 0; turn < 5; ++turn)
    bore.push_back(arc(tool, at(-2 * turn), at(-2 * (turn + 1)), center + Vec3(0, 0, -2 * turn), 360));
  bore.push_back(arc(tool, at(-10), at(-10), center + Vec3(0, 0, -10), 360));
  EXPECT_NEAR(error_of(stock, bore, pi * 81 * 10), 0, 0.002);
}

TEST(ClosedForm, HalfTorusOfABallOnACircle) {
  const RevolvedBody tool = ball(5);
  const Stock stock(block(), 0.25);
  EXPECT_NEAR(error_of(stock, {arc(tool, {20, 0, -5}, {20, 0, -5}, {0, 0, -5}, 360)}, pi * pi * 20 * 25), 0, 0.002);
}

/// A ball on a half circle in a vertical plane: the lower half of a torus, and all above it, which the shank removes.
TEST(ClosedForm, BallOnAHalfCircleInAVerticalPlane) {
  const RevolvedBody tool = ball(3, 60);
  const Stock stock(block(), 0.25);
  // The ball's center is 3 mm above the tip: at z = 0 at both ends.
  const Sweep sweep = arc(tool, {20, 0, -3}, {-20, 0, -3}, {0, 0, -3}, 180, {0, 1, 0});
  double expected = 0;
  constexpr int kSteps = 4000;
  for (int i = 0; i < kSteps; ++i) {
    const double y = -3 + 6 * (i + 0.5) / kSteps;
    const double radius = 20 + std::sqrt(9 - y * y);
    expected += pi * radius * radius / 2 * 6 / kSteps;
  }
  EXPECT_NEAR(error_of(stock, {sweep}, expected), 0, 0.002);
}

TEST(ClosedForm, RampOfEachCutter) {
  // At the height z of the tool's lowest point, the section of what a ramp of flat tools removes is a stadium that ends
  // where the ramp is at z. So the volume above the lower end is known by slices.
  const Stock stock(block(), 0.25);
  const RevolvedBody tool = flat(5);
  double expected = 0;
  constexpr int kSlices = 1000;
  for (int i = 0; i < kSlices; ++i) {
    const double depth = 10 * (i + 0.5) / kSlices;
    expected += (pi * 25 + 10 * (50 * (1 - depth / 10))) * 10 / kSlices;
  }
  EXPECT_NEAR(error_of(stock, {line(tool, {-25, 1, 0}, {25, 1, -10})}, expected), 0, 0.002);
}

TEST(ClosedForm, TiltedPlungeAndSlotThroughAPlate) {
  const Stock stock(box({-100, -100, -18}, {100, 100, 0}), 0.25);
  const RevolvedBody tool = flat(6, 200);
  for (const double degrees : {5.0, 20.0, 45.0, 60.0}) {
    const Vec3 axis = tilted(degrees);
    const double cosine = axis.z();
    const Vec3 from = 60 * axis;
    const Vec3 deep = -60 * axis;
    EXPECT_NEAR(error_of(stock, {line(tool, from, deep, axis)}, pi * 36 * 18 / cosine), 0, 0.003) << degrees;
    EXPECT_NEAR(error_of(stock, {line(tool, deep + Vec3(0, -30, 0), deep + Vec3(0, 30, 0), axis)},
                         (pi * 36 + 12 * 60) * 18 / cosine),
                0, 0.003)
        << degrees;
  }
}

/// Straight down, a tilted disc leaves a hole of its shadow: an ellipse, drawn out by its thickness.
TEST(ClosedForm, TiltedDiscStraightDown) {
  const Stock stock(box({-50, -50, -18}, {50, 50, 0}), 0.25);
  const RevolvedBody saw = body(solids::disc_body(6, 2));
  for (const double degrees : {20.0, 45.0, 70.0}) {
    const Vec3 axis = tilted(degrees);
    EXPECT_NEAR(error_of(stock, {line(saw, {0.1, 0.2, 20}, {0.1, 0.2, -40}, axis)},
                         (pi * 36 * axis.z() + 12 * 2 * axis.x()) * 18),
                0, 0.003)
        << degrees;
  }
}

/// The ball is in one tile, and its shank goes on through the next ones.
TEST(ClosedForm, LyingBallCutterThroughManyTiles) {
  const Stock stock(box({0, -30, -30}, {200, 30, 30}), 0.25);
  const double length = 150;
  EXPECT_NEAR(error_of(stock, {line(ball(6, length), {20, 0, 0}, {20, 0, 0}, {1, 0, 0})},
                       pi * 36 * (length - 6) + 2.0 / 3 * pi * 216),
              0, 0.003);
}

TEST(ClosedForm, ArcsOfLessThanAMillimeter) {
  const Stock stock(box({-2, -2, -5}, {2, 2, 0}), 0.01);
  const RevolvedBody tool = flat(0.3);
  for (const double degrees : {90.0, -90.0}) {
    const Vec3 to(0, degrees > 0 ? 0.8 : -0.8, -1);
    EXPECT_NEAR(error_of(stock, {arc(tool, {0.8, 0, -1}, to, {0, 0, -1}, degrees)}, pi / 2 * 0.8 * 0.6 + pi * 0.09), 0,
                0.005)
        << degrees;
  }
}

TEST(ClosedForm, HorizontalBore) {
  const Stock stock(box({-50, -50, -40}, {50, 50, 0}), 0.25);
  const RevolvedBody tool = flat(6, 200);
  EXPECT_NEAR(error_of(stock, {line(tool, {100, 0, -20}, {-60, 0, -20}, {1, 0, 0})}, pi * 36 * 100), 0, 0.003);
  const RevolvedBody saw = body(solids::disc_body(30, 4));
  // A disc with a horizontal axis along a line: a slot with the disc's ends.
  EXPECT_NEAR(error_of(stock, {line(saw, {-2, -100, 18}, {-2, 100, 18}, {1, 0, 0})}, 4 * 12 * 100), 0, 0.003);
}

TEST(ClosedForm, CrossedBores) {
  const Stock stock(box({-50, -50, -50}, {50, 50, 50}), 0.25);
  const RevolvedBody tool = flat(8, 200);
  const std::vector<Sweep> bores = {line(tool, {-60, 0, 0}, {-60, 0, 0}, {1, 0, 0}),
                                    line(tool, {0, -60, 0}, {0, -60, 0}, {0, 1, 0})};
  EXPECT_NEAR(error_of(stock, bores, 2 * pi * 64 * 100 - 16.0 * 512 / 3), 0, 0.003);
  const std::vector<Sweep> with_vertical = {line(tool, {-60, 0, 0}, {-60, 0, 0}, {1, 0, 0}),
                                            line(tool, {0, 0, -60}, {0, 0, -60}, {0, 0, 1})};
  EXPECT_NEAR(error_of(stock, with_vertical, 2 * pi * 64 * 100 - 16.0 * 512 / 3), 0, 0.003);
}

/// A capsule of the radius r whose axis, of the length l, turns by th about the center of its ball (Steiner).
TEST(ClosedForm, TurningCapsule) {
  const double r = 4;
  const double l = 30;
  const double th = 1.2;
  const RevolvedBody capsule({{.core = {0, 0, l, 0}, .rounding = r}});
  const RevolvedBody pieces(
      {{.core = {0, 0, 0, 0}, .rounding = r}, {.core = {0, r, l, r}}, {.core = {l, 0, l, 0}, .rounding = r}});
  const double expected = r * l * l * th + pi * r * r / 2 * (2 * l + l * th) + 4.0 / 3 * pi * r * r * r;
  const Stock stock(box({-50, -50, -50}, {50, 50, 50}), 0.25);
  const auto at = [](double angle) { return AxisPlacement{{0, 0, 0}, {std::sin(angle), 0, std::cos(angle)}}; };
  for (const RevolvedBody* tool : {&capsule, &pieces})
    EXPECT_NEAR(error_of(stock, {turn(*tool, at(-0.6), at(th - 0.6))}, expected), 0, 0.004);
}

/// The second pass is the first one, further along the tilted axis: whatever it meets, it takes this depth.
TEST(ClosedForm, DepthOfAPassAlongASlope) {
  const double depth = 0.8;
  for (const RevolvedBody& tool : {ball(10, 60), body(solids::bull_body(10, 3, 60)), flat(10, 60)})
    for (const double degrees : {-60.0, 20.0, 50.0})
      for (const double travel_x : {40.0, 3.0})
        for (const double climb : {-0.7, 0.0, 0.7}) {
          if (!support::kTriesAll && degrees != 50) continue;
          Stock stock(box({-60, -40, -40}, {60, 40, 0}), 0.4);
          const Vec3 axis = tilted(degrees);
          const Vec3 from(-travel_x / 2, -5, -9 - climb * travel_x / 2);
          const Vec3 to(travel_x / 2, 5, -9 + climb * travel_x / 2);
          Sweep pass = line(tool, from, to, axis);
          pass.side_rim = 1;
          apply(stock, pass);
          pass = line(tool, from - depth * axis, to - depth * axis, axis, 2);
          pass.side_rim = 1;
          pass.depth_limit = 0.5 * depth;
          const SweepOutcome outcome = apply(stock, pass);
          EXPECT_LT(outcome.inside_depth, depth + 0.02) << degrees << " degrees, X " << travel_x << ", climb " << climb;
          EXPECT_GT(outcome.inside_depth, 0.9 * depth) << degrees << " degrees, X " << travel_x << ", climb " << climb;
        }
}

/// The same of a ball that cuts with its lower part alone, whatever depth it is asked for.
TEST(ClosedForm, DepthOfAShallowPassOfABall) {
  const double depth = 0.8;
  const RevolvedBody tool = ball(10, 60);
  const Vec3 axis = tilted(20);
  const Vec3 middle = Vec3(0, 0, 9) - 10 * axis;  // The lowest point of the ball is 1 mm deep.
  for (const double limit : {0.4, 100.0}) {
    Stock stock(box({-60, -40, -40}, {60, 40, 0}), 0.4);
    const auto pass = [&](double along) {
      Sweep sweep = line(tool, middle - along * axis - Vec3(20, 0, 0), middle - along * axis + Vec3(20, 0, 0), axis);
      sweep.side_rim = 1;
      sweep.depth_limit = limit;
      return apply(stock, sweep);
    };
    const SweepOutcome first = pass(0);
    EXPECT_LE(first.inside_depth, first.depth) << limit;
    EXPECT_NEAR(first.depth, 1 * axis.z(), 0.01) << limit;
    const SweepOutcome second = pass(depth);
    EXPECT_LE(second.inside_depth, second.depth) << limit;
    if (limit > 1) continue;
    EXPECT_LT(second.inside_depth, depth + 0.02);
    EXPECT_GT(second.inside_depth, 0.9 * depth);
  }
}

}  // namespace
}  // namespace isocnc::stock::cuts
