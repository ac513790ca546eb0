#include <gtest/gtest.h>

#include <vector>

#include "scenes.h"

namespace isocnc::solids {
namespace {

using scenes::body;
using scenes::Random;
using scenes::Vec3;

/// Whether a point lies in a body that stands at the origin.
bool contains(const RevolvedBody& of, const Vec3& point) {
  for (const BodyPiece& piece : of.pieces()) {
    const Vec3 nearest = PlacedFrustum(piece.core, {}).nearest(point);
    if ((nearest - point).norm() <= piece.rounding + 1e-9) return true;
  }
  return false;
}

/// Whether the ball around a point, by points of its surface, lies in a body that goes on above its top.
bool contains_ball(const RevolvedBody& of, const Vec3& center, double radius, Random& random) {
  for (int i = 0; i < 400; ++i) {
    Vec3 point = center + radius * scenes::any_direction(random);
    if (point.z() > of.top()) continue;
    if (!contains(of, point)) return false;
  }
  return true;
}

std::vector<RevolvedBody> tools() {
  const std::vector<FormPoint> stepped = {{0, 0}, {0, 8}, {6, 8}, {6, 4}, {12, 4}, {16, 9}, {30, 9}};
  const std::vector<FormPoint> collar = {{0, 4}, {10, 4}, {11, 8}, {12, 3}, {30, 3}};
  return {body(flat_body(5, 30)),      body(ball_body(5, 30)),        body(bull_body(6, 2, 30)),
          body(bull_body(6, 0.2, 30)), body(cone_body(5, 1, 90, 30)), body(drill_body(5, 118, 30)),
          body(form_body(stepped)),    body(form_body(collar))};
}

TEST(ReducedBody, OfSimpleToolsIsTheSameToolWithSmallerMeasures) {
  const RevolvedBody flat = *body(flat_body(5, 30)).reduced(0.5);
  EXPECT_NEAR(flat.bottom(), 0.5, 1e-12);
  EXPECT_EQ(flat.top(), 30);
  EXPECT_NEAR(flat.maximum_radius(), 4.5, 1e-12);
  const RevolvedBody ball = *body(ball_body(5, 30)).reduced(0.5);
  EXPECT_EQ(ball.pieces().front().rounding, 4.5);
  EXPECT_NEAR(ball.maximum_radius(), 4.5, 1e-12);
  const RevolvedBody drill = *body(drill_body(5, 90, 30)).reduced(0.5);
  EXPECT_NEAR(drill.bottom(), 0.5 * std::sqrt(2), 1e-9);
}

TEST(ReducedBody, IsTheBodyItselfForNoDepthAndNothingForALargeOne) {
  EXPECT_EQ(body(flat_body(5, 30)).reduced(0)->maximum_radius(), 5);
  EXPECT_FALSE(body(flat_body(5, 30)).reduced(5));
  EXPECT_FALSE(body(flat_body(5, 30)).reduced(40));
}

/// Every point of what remains is as deep as asked for, and what is clearly deeper remains.
TEST(ReducedBody, KeepsWhatIsDeepEnough) {
  constexpr double kDepth = 0.5;
  Random random(5);
  for (const RevolvedBody& tool : tools()) {
    const RevolvedBody reduced = *tool.reduced(kDepth);
    int kept = 0;
    for (int i = 0; i < 1'500; ++i) {
      const Vec3 point(random.real(0, 10), 0, random.real(-1, 31));
      if (point.z() > tool.top()) continue;
      if (contains(reduced, point)) {
        ++kept;
        ASSERT_TRUE(contains_ball(tool, point, kDepth - 1e-6, random)) << point.transpose();
      } else {
        ASSERT_FALSE(contains_ball(tool, point, 1.35 * kDepth, random)) << point.transpose();
      }
    }
    EXPECT_GT(kept, 100);
  }
}

/// Every place of a body is compared with the material piece by piece: a few for a holder of three steps.
TEST(ReducedBody, OfAHolderHasFewPieces) {
  const RevolvedBody holder(
      {{.core = {70, 12.5, 120, 20}}, {.core = {120, 15, 160, 25}}, {.core = {160, 31.5, 183, 31.5}}});
  const RevolvedBody reduced = *holder.reduced(0.08);
  EXPECT_LE(reduced.pieces().size(), 12U);
  EXPECT_DOUBLE_EQ(reduced.bottom(), 70.08);
  EXPECT_DOUBLE_EQ(reduced.top(), 183);
  EXPECT_DOUBLE_EQ(reduced.maximum_radius(), 31.42);
}

/// Finishing at distance 0 is clear of the target, and a cut below its surface is as deep as it is.
TEST(ReducedBody, OfACutterLeavesAFinishingPassClear) {
  const Cuboid part{{0, 0, -20}, {100, 100, 0}};
  const RevolvedBody cutter = *body(bull_body(6, 1, 30)).reduced(0.2);
  EXPECT_NEAR(clearance(cutter, {{50, 50, 0}, {0, 0, 1}}, part).lower, 0.2, 2e-6);
  EXPECT_NEAR(clearance(cutter, {{-6, 50, -10}, {0, 0, 1}}, part).lower, 0.2, 2e-6);
  EXPECT_NEAR(clearance(cutter, {{50, 50, -0.5}, {0, 0, 1}}, part).depth(), 0.3, 2e-6);
}

}  // namespace
}  // namespace isocnc::solids
