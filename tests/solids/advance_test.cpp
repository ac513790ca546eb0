#include "interpreter/solids/advance.h"

#include <gtest/gtest.h>

#include <limits>

#include "scenes.h"

namespace isocnc::solids {
namespace {

using scenes::body;
using scenes::Vec3;
using Verdict = AdvanceResult::Verdict;

const Cuboid kClamp{{0, 0, 0}, {100, 60, 20}};
constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// A flat tool of radius 10 that moves along X at a height, 1 mm for each unit of s.
struct StraightPass {
  double y = 30;
  double z = 15;
  RevolvedBody tool = body(flat_body(10, 80));

  Clearance distance(double s, double sufficient) const {
    return clearance(tool, {{s, y, z}, {0, 0, 1}}, kClamp, sufficient);
  }
  AdvanceResult advance(double begin, double end, const AdvanceOptions& options = {}, double speed = 1) const {
    return first_contact(
        begin, end, [&](double s, double sufficient) { return distance(s, sufficient); }, [&](double) { return speed; },
        options);
  }
};

TEST(Advance, FindsTheFirstTouch) {
  const AdvanceResult result = StraightPass().advance(-200, 200);
  EXPECT_EQ(result.verdict, Verdict::Contact);
  EXPECT_LE(result.s, -10 + 1e-6);
  EXPECT_GE(result.s, -10 - 0.01);
  EXPECT_LT(result.evaluations, 10);
}

TEST(Advance, ProvesThatThereIsNone) {
  const AdvanceResult result = StraightPass{.z = 21}.advance(-200, 200);
  EXPECT_EQ(result.verdict, Verdict::Clear);
  EXPECT_EQ(result.s, 200);
  EXPECT_LE(result.proven, 1);
  EXPECT_GT(result.proven, 0);
}

/// Far away, one distance does for the whole motion.
TEST(Advance, TakesOneStepWhereNothingIsNear) { EXPECT_EQ(StraightPass{.y = 2000}.advance(-200, 200).evaluations, 1); }

TEST(Advance, FindsHowNearAMotionComes) {
  const AdvanceOptions options{.clearance = 10, .tolerance = 0.05};
  const AdvanceResult result = StraightPass{.z = 23}.advance(-200, 200, options);
  EXPECT_EQ(result.verdict, Verdict::Clear);
  EXPECT_NEAR(result.nearest, 3, 1e-5);
  EXPECT_GE(result.proven, 3 - 0.051);
  EXPECT_GE(result.nearest_s, -10.001);
  EXPECT_GE(StraightPass{.z = 35}.advance(-200, 200, options).proven, 9.9);
  const AdvanceResult farther = StraightPass{.z = 300}.advance(-200, 200, {.clearance = kUnbounded});
  EXPECT_NEAR(farther.nearest, 280, 0.1);
}

/// Along a face, just above the limit, over a long way: many steps, but no more than told.
TEST(Advance, EndsWhereItGrazes) {
  const AdvanceResult result = StraightPass{.z = 20 + 0.0101}.advance(0, 90, {.max_evaluations = 100'000});
  EXPECT_EQ(result.verdict, Verdict::Clear);
  EXPECT_LE(result.evaluations, 2 + 90 / (0.9 * 0.005));
  const AdvanceResult short_of_breath = StraightPass{.z = 20 + 0.0101}.advance(0, 90, {.max_evaluations = 50});
  EXPECT_EQ(short_of_breath.verdict, Verdict::Undecided);
  EXPECT_EQ(short_of_breath.evaluations, 50);
  EXPECT_GT(short_of_breath.s, 0.2);
  EXPECT_LT(short_of_breath.s, 1);
}

TEST(Advance, IsUndecidedWithoutABoundOnTheSpeed) {
  const StraightPass high{.z = 30};
  EXPECT_EQ(high.advance(0, 10, {}, kUnbounded).verdict, Verdict::Undecided);
  EXPECT_EQ(high.advance(0, 10, {}, std::nan("")).verdict, Verdict::Undecided);
  EXPECT_EQ(high.advance(0, 10, {}, -1).verdict, Verdict::Undecided);
  EXPECT_EQ(high.advance(10, 0).verdict, Verdict::Undecided);
  EXPECT_EQ(high.advance(0, std::nan("")).verdict, Verdict::Undecided);
  // A contact is one all the same.
  EXPECT_EQ(StraightPass{.z = 10}.advance(0, 10, {}, kUnbounded).verdict, Verdict::Contact);
}

TEST(Advance, NeedsOneDistanceAtRest) {
  const StraightPass high{.z = 30};
  EXPECT_EQ(high.advance(0, 10, {}, 0).verdict, Verdict::Clear);
  EXPECT_EQ(high.advance(0, 10, {}, 0).evaluations, 1);
  EXPECT_EQ(high.advance(5, 5, {}, kUnbounded).verdict, Verdict::Clear);
  EXPECT_EQ(StraightPass{.z = 19}.advance(5, 5).verdict, Verdict::Contact);
}

TEST(Advance, IsUndecidedWhereAPlacementIsNotFinite) {
  const AdvanceResult result = first_contact(
      0, 10,
      [&](double s, double sufficient) {
        return clearance(body(flat_body(1, 10)), {{s, 0, 30 + std::sqrt(4 - s)}, {0, 0, 1}}, kClamp, sufficient);
      },
      [](double) { return 2.0; }, {.clearance = 100, .tolerance = 1});
  EXPECT_EQ(result.verdict, Verdict::Undecided);
  EXPECT_GT(result.s, 1);
}

TEST(Advance, FollowsAContactToItsEnd) {
  const StraightPass pass;
  const auto distance = [&](double s, double sufficient) { return pass.distance(s, sufficient); };
  const auto speed = [](double) { return 1.0; };
  const ContactSpan whole = follow_contact(-10, 200, distance, speed, 0.01);
  EXPECT_TRUE(whole.is_over);
  EXPECT_NEAR(whole.last, 110, 0.02);
  EXPECT_GE(whole.free, whole.last);
  EXPECT_NEAR(whole.deepest.depth(), 5, 1e-6);
  EXPECT_NEAR(whole.deepest_s, -5, 1) << "the first one of equally deep places";
  EXPECT_LE(whole.evaluations, kMaxContactSteps + 20);
  const ContactSpan open = follow_contact(-10, 50, distance, speed, 0.01);
  EXPECT_FALSE(open.is_over);
  EXPECT_EQ(open.last, 50);
}

/// A head that tilts about its pivot: the tip's speed is the angle's times the reach, and the sampled distances agree.
TEST(Advance, AgreesWithSamplesOfTiltingMotions) {
  int contacts = 0;
  for (const std::uint64_t seed : support::seeds(150)) {
    scenes::Random random(seed);
    const RevolvedBody tool = scenes::any_body(random);
    const Cuboid box = scenes::any_cuboid(random);
    const Vec3 pivot = box.middle() + 150 * scenes::any_direction(random);
    const Vec3 along = scenes::any_point(random, 60);
    const Vec3 first = scenes::any_direction(random);
    const Vec3 second = first.cross(scenes::any_direction(random)).normalized();
    const double length = random.real(20, 150);
    const double turn = random.real(0, 2);
    const auto at = [&](double s) {
      const Vec3 axis = std::cos(turn * s) * first + std::sin(turn * s) * second;
      return AxisPlacement{pivot + s * along - length * axis, axis};
    };
    const double speed = along.norm() + turn * tool.reach(length);
    const AdvanceResult result = first_contact(
        0, 1, [&](double s, double sufficient) { return clearance(tool, at(s), box, sufficient); },
        [&](double) { return speed; }, {.clearance = 5, .tolerance = 0.5});
    ASSERT_NE(result.verdict, Verdict::Undecided) << seed;
    contacts += result.verdict == Verdict::Contact ? 1 : 0;
    for (double s = 0; s < result.s; s += 0.01) {
      const Clearance sampled = clearance(tool, at(s), box);
      ASSERT_GT(sampled.upper, 0.005) << seed << " at " << s;
      ASSERT_LE(result.proven, sampled.upper) << seed << " at " << s;
    }
  }
  if (support::kTriesAll) {
    EXPECT_GT(contacts, 10);
    EXPECT_LT(contacts, 140);
  }
}

}  // namespace
}  // namespace isocnc::solids
