#include "interpreter/geometry/arc.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/random.h"

namespace isocnc::geometry {
namespace {

using support::Random;

constexpr double kTolerance = 0.01;

/// An arc made from what is to be found: its center, its radius and how far it turns.
struct KnownArc {
  PlanePoint center;
  PlanePoint end;
  double radius = 0;
  double sweep_deg = 0;

  bool counterclockwise() const { return sweep_deg > 0; }
};

KnownArc known_arc(double radius, double start_deg, double sweep_deg) {
  const double degree = std::numbers::pi / 180;
  const PlanePoint start{radius * std::cos(start_deg * degree), radius * std::sin(start_deg * degree)};
  const double end_deg = start_deg + sweep_deg;
  return {.center = {-start.u, -start.v},
          .end = {radius * std::cos(end_deg * degree) - start.u, radius * std::sin(end_deg * degree) - start.v},
          .radius = radius,
          .sweep_deg = sweep_deg};
}

KnownArc random_arc(Random& random, double max_deg) {
  const double sweep = random.real(1, max_deg);
  return known_arc(random.real(0.5, 1'000), random.real(0, 360), random.one_in(2) ? sweep : -sweep);
}

double distance(const PlanePoint& a, const PlanePoint& b) { return (a - b).norm(); }

TEST(FindCircle, BothCenterCoordinatesAreTheCenter) {
  for (const std::uint64_t seed : support::seeds(5'000)) {
    Random random(seed);
    const KnownArc arc = random_arc(random, 359);
    const Circle circle = find_circle({.end = arc.end,
                                       .center_u = arc.center.u,
                                       .center_v = arc.center.v,
                                       .counterclockwise = arc.counterclockwise()},
                                      kTolerance);
    ASSERT_EQ(circle.problem, ArcProblem::None) << "seed " << seed;
    EXPECT_EQ(distance(circle.center, arc.center), 0) << "seed " << seed;
    EXPECT_NEAR(sweep_deg(circle.center, arc.end, arc.counterclockwise()), arc.sweep_deg, 1e-6) << "seed " << seed;
  }
}

TEST(FindCircle, OneCenterCoordinateGivesTheOther) {
  for (const std::uint64_t seed : support::seeds(5'000)) {
    Random random(seed);
    const KnownArc arc = random_arc(random, 359);
    const bool by_u = random.one_in(2);
    if (std::abs(by_u ? arc.end.v : arc.end.u) < 1e-3) continue;  // Hardly determined.
    ArcGiven given{.end = arc.end, .counterclockwise = arc.counterclockwise()};
    (by_u ? given.center_u : given.center_v) = by_u ? arc.center.u : arc.center.v;
    const Circle circle = find_circle(given, kTolerance);
    ASSERT_EQ(circle.problem, ArcProblem::None) << "seed " << seed;
    EXPECT_LT(distance(circle.center, arc.center), 1e-6) << "seed " << seed;
    EXPECT_NEAR(circle.center.norm(), distance(circle.center, arc.end), 1e-6) << "seed " << seed;
  }
}

TEST(FindCircle, RadiusFormTurnsByAtMostHalf) {
  for (const std::uint64_t seed : support::seeds(5'000)) {
    Random random(seed);
    const KnownArc arc = random_arc(random, 360);
    const Circle circle =
        find_circle({.end = arc.end, .radius = arc.radius, .counterclockwise = arc.counterclockwise()}, kTolerance);
    ASSERT_EQ(circle.problem, ArcProblem::None) << "seed " << seed;
    const double sweep = sweep_deg(circle.center, arc.end, arc.counterclockwise());
    EXPECT_EQ(sweep > 0, arc.counterclockwise()) << "seed " << seed;
    EXPECT_LE(std::abs(sweep), 180 + 1e-6) << "seed " << seed;
    EXPECT_NEAR(std::abs(sweep), std::min(std::abs(arc.sweep_deg), 360 - std::abs(arc.sweep_deg)), 1e-4)
        << "seed " << seed;
    EXPECT_NEAR(circle.center.norm(), arc.radius, 1e-6 * arc.radius) << "seed " << seed;
    EXPECT_NEAR(distance(circle.center, arc.end), arc.radius, 1e-6 * arc.radius) << "seed " << seed;
  }
}

TEST(FindCircle, WithAConsistentRadiusTheCenterDecides) {
  const KnownArc arc = known_arc(10, 0, 270);
  const Circle circle = find_circle(
      {.end = arc.end, .center_u = arc.center.u, .center_v = arc.center.v, .radius = 10.005, .counterclockwise = true},
      kTolerance);
  ASSERT_EQ(circle.problem, ArcProblem::None);
  EXPECT_NEAR(sweep_deg(circle.center, arc.end, true), 270, 1e-9);
}

TEST(FindCircle, HalfCirclesOfEitherSense) {
  for (const bool counterclockwise : {false, true}) {
    const PlanePoint end{20, 0};
    const Circle circle = find_circle({.end = end, .radius = 10, .counterclockwise = counterclockwise}, kTolerance);
    ASSERT_EQ(circle.problem, ArcProblem::None);
    EXPECT_LT(distance(circle.center, {10, 0}), 1e-9);
    EXPECT_NEAR(sweep_deg(circle.center, end, counterclockwise), counterclockwise ? 180 : -180, 1e-9);
  }
}

TEST(FindCircle, ChordMayExceedTheDiameterByTheTolerance) {
  const auto problem = [](double chord) { return find_circle({.end = {chord, 0}, .radius = 10}, kTolerance).problem; };
  EXPECT_EQ(problem(20.0099), ArcProblem::None);
  EXPECT_EQ(problem(20.0101), ArcProblem::RadiusTooSmall);
}

TEST(SweepDeg, EqualEndsTurnFully) {
  EXPECT_EQ(sweep_deg({5, 0}, {0, 0}, true), 360);
  EXPECT_EQ(sweep_deg({5, 0}, {0, 0}, false), -360);
  EXPECT_EQ(sweep_deg({5, 0}, {0.5e-6, -0.5e-6}, true), 360);
}

struct Quarter {
  PlanePoint end;
  bool counterclockwise;
  double sweep;
};

class Quarters : public testing::TestWithParam<Quarter> {};

/// From the start at the right of the center, 10 away.
TEST_P(Quarters, TurnInTheirSense) {
  EXPECT_NEAR(sweep_deg({-10, 0}, GetParam().end, GetParam().counterclockwise), GetParam().sweep, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(AroundTheClock, Quarters,
                         testing::Values(Quarter{{-10, 10}, true, 90}, Quarter{{-20, 0}, true, 180},
                                         Quarter{{-10, -10}, true, 270}, Quarter{{-10, 10}, false, -270},
                                         Quarter{{-20, 0}, false, -180}, Quarter{{-10, -10}, false, -90}));

TEST(SweepDeg, StaysWithinAFullTurnAndKeepsItsSense) {
  for (const std::uint64_t seed : support::seeds(5'000)) {
    Random random(seed);
    const bool counterclockwise = random.one_in(2);
    const double sweep =
        sweep_deg({random.real(-1, 1), random.real(-1, 1)}, {random.real(-1, 1), random.real(-1, 1)}, counterclockwise);
    EXPECT_LE(std::abs(sweep), 360) << "seed " << seed;
    EXPECT_EQ(sweep > 0, counterclockwise) << "seed " << seed;
  }
}

struct Problem {
  const char* name;
  ArcGiven given;
  ArcProblem problem;
};

class Problems : public testing::TestWithParam<Problem> {};

TEST_P(Problems, AreReported) { EXPECT_EQ(find_circle(GetParam().given, kTolerance).problem, GetParam().problem); }

INSTANTIATE_TEST_SUITE_P(
    All, Problems,
    testing::Values(
        Problem{"UAloneNeedsEndsApartInV", {.end = {10, 0}, .center_u = 5}, ArcProblem::CenterUndeterminedByU},
        Problem{"VAloneNeedsEndsApartInU", {.end = {0, 10}, .center_v = 5}, ArcProblem::CenterUndeterminedByV},
        Problem{"UAloneWithEqualEnds", {.end = {0, 0}, .center_u = 5}, ArcProblem::CenterUndeterminedByU},
        Problem{"UAloneWithRadius", {.end = {10, 0}, .center_u = 5, .radius = 5}, ArcProblem::CenterUndeterminedByU},
        Problem{"EndsJustApart", {.end = {0, 2e-6}, .center_u = 5}, ArcProblem::None},
        Problem{"CenterNearerToTheStart", {.end = {10, 0}, .center_u = 4, .center_v = 0}, ArcProblem::CenterMismatch},
        Problem{"CenterOnTheStart", {.end = {0, 0}, .center_u = 0, .center_v = 0}, ArcProblem::CenterMismatch},
        Problem{"CenterWithinTolerance", {.end = {10, 0}, .center_u = 5.0049, .center_v = 0}, ArcProblem::None},
        Problem{
            "CenterBeyondTolerance", {.end = {10, 0}, .center_u = 5.0051, .center_v = 0}, ArcProblem::CenterMismatch},
        Problem{"RadiusOfAnotherCircle",
                {.end = {10, 0}, .center_u = 5, .center_v = 0, .radius = 5.02},
                ArcProblem::RadiusMismatch},
        Problem{"CenterBeforeRadius",
                {.end = {10, 0}, .center_u = 4, .center_v = 0, .radius = 9},
                ArcProblem::CenterMismatch},
        Problem{"RadiusTooSmall", {.end = {10, 0}, .radius = 4.9}, ArcProblem::RadiusTooSmall},
        Problem{"RadiusZero", {.end = {0, 0}, .radius = 0}, ArcProblem::RadiusTooSmall},
        Problem{"RadiusNegative", {.end = {10, 0}, .radius = -50}, ArcProblem::RadiusTooSmall}),
    [](const testing::TestParamInfo<Problem>& each) { return std::string(each.param.name); });

TEST(FindCircle, ReportsWhatWasFound) {
  const Circle mismatch = find_circle({.end = {10, 0}, .center_u = 4, .center_v = 0}, kTolerance);
  EXPECT_EQ(mismatch.found, 4);
  EXPECT_EQ(mismatch.wanted, 6);
  const Circle small = find_circle({.end = {10, 0}, .radius = 3}, kTolerance);
  EXPECT_EQ(small.found, 3);
  EXPECT_EQ(small.wanted, 5);
}

TEST(FindCircle, ByRadiusFromAPointToItselfGoesNowhere) {
  const Circle circle = find_circle({.end = {0, 0}, .radius = 5}, kTolerance);
  EXPECT_EQ(circle.problem, ArcProblem::None);
  EXPECT_TRUE(circle.goes_nowhere);
}

TEST(SurelyFits, IsNeverWrong) {
  for (const std::uint64_t seed : support::seeds(20'000)) {
    Random random(seed);
    const KnownArc arc = random_arc(random, 359);
    const auto nearly = [&](double value) { return value + random.real(-2, 2) * kTolerance; };
    ArcGiven given{.end = {nearly(arc.end.u), nearly(arc.end.v)}, .counterclockwise = arc.counterclockwise()};
    if (!random.one_in(3)) given.center_u = nearly(arc.center.u);
    if (!random.one_in(3)) given.center_v = nearly(arc.center.v);
    if (random.one_in(3) || (!given.center_u && !given.center_v)) given.radius = nearly(arc.radius);
    if (!surely_fits(given, kTolerance)) continue;
    EXPECT_EQ(find_circle(given, kTolerance).problem, ArcProblem::None) << "seed " << seed;
  }
  EXPECT_FALSE(surely_fits({.end = {1, 0}, .center_u = 0, .center_v = 0}, kTolerance));
  EXPECT_FALSE(surely_fits({.end = {1, 0}, .center_u = std::nan(""), .center_v = 0}, kTolerance));
  EXPECT_FALSE(surely_fits({.end = {1, 0}, .radius = -5}, kTolerance));
}

TEST(SurelyFits, KnowsArcsThatLieOnTheirCircle) {
  for (const std::uint64_t seed : support::seeds(1'000)) {
    Random random(seed);
    const KnownArc arc = random_arc(random, 179);
    const double rounding = 0.0005;
    EXPECT_TRUE(
        surely_fits({.end = arc.end, .center_u = arc.center.u + rounding, .center_v = arc.center.v}, kTolerance));
    EXPECT_TRUE(surely_fits({.end = arc.end, .radius = arc.radius}, kTolerance));
    const double half_chord = std::floor(arc.end.norm() / 2 * 1'000) / 1'000;  // A half circle, written in microns.
    EXPECT_TRUE(surely_fits({.end = arc.end, .radius = half_chord}, kTolerance));
  }
}

/// Arcs about a center that is as far from the end as from the start, but for up to twice of what "nearly" allows.
TEST(SurelyAbsolute, IsNeverWrongAndKnowsWhatDoesNotNearlyFit) {
  constexpr double kNearly = CenterReadings::kNearly * kTolerance;
  for (const std::uint64_t seed : support::seeds(20'000)) {
    Random random(seed);
    const KnownArc arc = random_arc(random, 359);
    const PlanePoint start{random.real(-500, 500), random.real(-500, 500)};
    const double part = 1 + random.real(-2, 2) * kNearly / arc.radius;
    const PlanePoint from_center = arc.end - arc.center;
    const PlanePoint end{arc.center.u + part * from_center.u, arc.center.v + part * from_center.v};
    ArcGiven given{.end = end, .center_u = arc.center.u - start.u, .center_v = arc.center.v - start.v};
    const double misfit = std::abs(part - 1) * arc.radius;
    const bool is_sure = surely_absolute(given, start, kTolerance);
    EXPECT_TRUE(is_sure ? misfit > 0.999 * kNearly : misfit < 1.415 * kNearly) << "seed " << seed;
    given.center_v.reset();
    EXPECT_FALSE(surely_absolute(given, start, kTolerance)) << "seed " << seed;
  }
}

/// However small the tolerance: an arc about a center that is equally far from both ends may be meant so.
TEST(SurelyAbsolute, IsNotSureOfAnArcThatFitsBothWays) {
  const PlanePoint start{10, 0};
  const ArcGiven given{.end = {-20, 0}, .center_u = -20, .center_v = 5};  // About (-10, 5), or from the start (0, 5).
  for (const double tolerance : {0.0, 1e-9, 0.01}) EXPECT_FALSE(surely_absolute(given, start, tolerance)) << tolerance;
}

}  // namespace
}  // namespace isocnc::geometry
