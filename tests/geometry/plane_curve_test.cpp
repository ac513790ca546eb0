#include "interpreter/geometry/plane_curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/plane_curves.h"
#include "tests/support/random.h"

namespace isocnc::geometry {
namespace {

using std::numbers::pi;
using support::arc;
using support::line;
using support::point_on;

void expect_point(const Vec2& found, const Vec2& expected) {
  EXPECT_NEAR(found.x(), expected.x(), 1e-9);
  EXPECT_NEAR(found.y(), expected.y(), 1e-9);
}

TEST(PlaneCurve, KnowsItsLengthAndWhereItLeads) {
  expect_point(line({1, 1}, {4, 5}).direction_at_end(), {0.6, 0.8});
  EXPECT_DOUBLE_EQ(line({1, 1}, {4, 5}).length(), 5);
  const PlaneCurve quarter = arc({10, 0}, {0, 0}, pi / 2);
  EXPECT_DOUBLE_EQ(quarter.length(), 5 * pi);
  expect_point(quarter.direction_at_start(), {0, 1});
  expect_point(quarter.direction_at_end(), {-1, 0});
  expect_point(arc({10, 0}, {0, 0}, -pi / 2).direction_at_start(), {0, -1});
}

TEST(PlaneCurve, BesideIsParallelToTheLeft) {
  const PlaneCurve shifted = beside(line({0, 0}, {10, 0}), 2);
  expect_point(shifted.start, {0, 2});
  expect_point(shifted.end, {10, 2});
  expect_point(beside(line({0, 0}, {10, 0}), -2).start, {0, -2});
  EXPECT_NEAR(beside(arc({10, 0}, {0, 0}, pi / 2), 3).radius(), 7, 1e-12);
  EXPECT_NEAR(beside(arc({10, 0}, {0, 0}, pi / 2), -3).radius(), 13, 1e-12);
  EXPECT_NEAR(beside(arc({10, 0}, {0, 0}, -pi / 2), 3).radius(), 13, 1e-12);
}

TEST(PlaneCurve, InsideAnArcThatIsTooSmallNothingIsLeft) {
  const PlaneCurve small = arc({10, 0}, {0, 0}, pi / 2);
  EXPECT_TRUE(vanishes_beside(small, 10));
  EXPECT_TRUE(vanishes_beside(small, 12));
  EXPECT_FALSE(vanishes_beside(small, -12));
  const PlaneCurve shifted = beside(small, 12);
  EXPECT_FALSE(shifted.is_arc());
  expect_point(shifted.start, {-2, 0});
  expect_point(shifted.end, {0, -2});
}

TEST(PlaneCurve, CrossesAnother) {
  const Crossings lines = crossings(line({0, 0}, {10, 0}), line({4, -3}, {4, 3}));
  ASSERT_EQ(lines.count, 1);
  expect_point(lines.at[0].point, {4, 0});
  EXPECT_DOUBLE_EQ(lines.at[0].along_first, 4);
  EXPECT_DOUBLE_EQ(lines.at[0].along_second, 3);
  EXPECT_EQ(crossings(line({0, 0}, {10, 0}), line({4, 1}, {4, 3})).count, 0);
  EXPECT_EQ(crossings(line({0, 0}, {10, 0}), line({0, 1}, {10, 1})).count, 0);

  const Crossings secant = crossings(line({-10, 3}, {10, 3}), arc({5, 0}, {0, 0}, 2 * pi));
  ASSERT_EQ(secant.count, 2);
  expect_point(secant.at[0].point, {-4, 3});
  expect_point(secant.at[1].point, {4, 3});
  EXPECT_NEAR(secant.at[1].along_second, 5 * std::atan2(3, 4), 1e-9);
  EXPECT_EQ(crossings(line({-10, 3}, {10, 3}), arc({5, 0}, {0, 0}, pi / 2)).count, 1);
  EXPECT_EQ(crossings(line({-10, 6}, {10, 6}), arc({5, 0}, {0, 0}, 2 * pi)).count, 0);

  const Crossings circles = crossings(arc({5, 0}, {0, 0}, 2 * pi), arc({11, 0}, {6, 0}, 2 * pi));
  ASSERT_EQ(circles.count, 2);
  expect_point(circles.at[0].point, {3, -4});
  expect_point(circles.at[1].point, {3, 4});
}

TEST(PlaneCurve, IsCutAtAPoint) {
  const PlaneCurve half = arc({5, 0}, {0, 0}, pi).to({0, 5}, 2.5 * pi);
  EXPECT_DOUBLE_EQ(half.sweep, pi / 2);
  expect_point(half.end, {0, 5});
  const PlaneCurve rest = arc({5, 0}, {0, 0}, pi).from({0, 5}, 2.5 * pi);
  EXPECT_DOUBLE_EQ(rest.sweep, pi / 2);
  expect_point(rest.start, {0, 5});
  expect_point(rest.end, {-5, 0});
}

PlaneCurve random_curve(support::Random& random) {
  const Vec2 start(random.real(-10, 10), random.real(-10, 10));
  const Vec2 other(random.real(-10, 10), random.real(-10, 10));
  return random.one_in(2) ? line(start, other) : arc(start, other, random.real(0.2, 6) * (random.one_in(2) ? 1 : -1));
}

/// Against the nearest of many points on both.
TEST(PlaneCurveProperty, ApproachIsTheMinimumDistanceOfAllPoints) {
  constexpr int kPoints = 60;
  for (const std::uint64_t seed : support::seeds(100)) {
    support::Random random(seed);
    const PlaneCurve first = random_curve(random);
    const PlaneCurve second = random_curve(random);
    double minimum = 1e9;
    for (int i = 0; i <= kPoints; ++i)
      for (int j = 0; j <= kPoints; ++j)
        minimum = std::min(minimum, (point_on(first, 1.0 * i / kPoints) - point_on(second, 1.0 * j / kPoints)).norm());
    const double coarse = (first.length() + second.length()) / kPoints;
    const Approach nearest = approach(first, second);
    const double found = nearest.distance();
    EXPECT_LE(found, minimum + 1e-9) << seed;
    EXPECT_GE(found, minimum - coarse) << seed;
    EXPECT_NEAR(approach(second, first).distance(), found, 1e-9) << seed;
    EXPECT_NEAR(support::distance_from(nearest.on_first, first), 0, 1e-6) << seed;
    EXPECT_NEAR(support::distance_from(nearest.on_second, second), 0, 1e-6) << seed;
  }
}

}  // namespace
}  // namespace isocnc::geometry
