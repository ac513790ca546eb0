#include "interpreter/solids/clearance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numbers>

#include "scenes.h"

namespace isocnc::solids {
namespace {

using scenes::body;
using scenes::Random;
using scenes::upright;
using scenes::Vec3;

constexpr double kExactly = 2e-6;

const Cuboid kBlock{{0, 0, 0}, {100, 60, 20}};

TEST(Clearance, OfACylinderAboveABlockIsItsHeight) {
  const Clearance found = clearance(body(flat_body(10, 80)), upright(50, 30, 33), kBlock);
  EXPECT_NEAR(found.lower, 13, kExactly);
  EXPECT_NEAR(found.upper, 13, kExactly);
  EXPECT_NEAR(found.on_obstacle.z(), 20, 1e-9);
}

TEST(Clearance, OfACylinderBesideABlockIsMeasuredFromItsSide) {
  EXPECT_NEAR(clearance(body(flat_body(10, 80)), upright(115, 30, 5), kBlock).lower, 5, kExactly);
  // Beside an upright edge, which is 3-4-5 away.
  EXPECT_NEAR(clearance(body(flat_body(10, 80)), upright(109, 72, 5), kBlock).lower, 15 - 10, kExactly);
}

TEST(Clearance, OfABallFromACornerIsThatOfItsCenter) {
  const Vec3 center(100 + 20, 60 + 30, 20 + 60);
  EXPECT_NEAR(clearance(body(ball_body(5, 50)), upright(120, 90, 75), kBlock).lower,
              (center - Vec3(100, 60, 20)).norm() - 5, kExactly);
}

TEST(Clearance, OfCrossedCylindersIsThatOfTheirAxes) {
  const Cylinder pin{.at = {{-50, 0, 0}, {1, 0, 0}}, .height = 100, .radius = 8};
  const AxisPlacement across{{0, 30, -40}, {0, 0, 1}};
  EXPECT_NEAR(clearance(body(flat_body(10, 80)), across, pin).lower, 30 - 8 - 10, kExactly);
}

TEST(Clearance, OfATiltedCylinderIsThatOfItsRim) {
  const double angle = 0.5;
  const AxisPlacement tilted{{50, 30, 50}, {std::sin(angle), 0, std::cos(angle)}};
  EXPECT_NEAR(clearance(body(flat_body(10, 80)), tilted, kBlock).lower, 30 - 10 * std::sin(angle), kExactly);
}

/// Out sideways, the shank is free of what the holder is above.
TEST(Clearance, OfAShankBesideWhatTheHolderIsAboveIsThatOfTheShank) {
  const std::vector<StackRow> rows = {{10, 10, 10}, {20, 16, 16}};
  const RevolvedBody holder = body(stacked_body(rows, 0));
  const Clearance found = clearance(holder, upright(-4.8, 30, 10.1), kBlock);
  EXPECT_NEAR(found.upper, -0.2, kExactly);
  EXPECT_NEAR(found.way_out.x(), -1, kExactly);
}

TEST(Clearance, OfAStackIsThatOfItsNearestPiece) {
  const std::vector<StackRow> rows = {{40, 20, 20}, {30, 80, 80}};
  const RevolvedBody holder = body(stacked_body(rows, 0));
  EXPECT_NEAR(clearance(holder, upright(-30, 30, 12), kBlock).lower, 20, kExactly);
  EXPECT_NEAR(clearance(holder, upright(-30, 30, -15), kBlock).upper, 0, 40);
  EXPECT_NEAR(clearance(holder, upright(-12, 30, 0), kBlock).lower, 2, kExactly);
}

TEST(Clearance, IsMinusTheDepthOfAnOverlap) {
  const RevolvedBody tool = body(flat_body(10, 80));
  EXPECT_NEAR(clearance(tool, upright(50, 30, 17), kBlock).upper, -3, 1e-6);
  EXPECT_NEAR(clearance(tool, upright(105, 30, 5), kBlock).depth(), 5, 1e-6);
  EXPECT_NEAR(clearance(body(ball_body(10, 80)), upright(50, 30, 18.5), kBlock).depth(), 1.5, 1e-6);
  const Cylinder pin{.at = {{0, 0, 0}, {0, 0, 1}}, .height = 30, .radius = 8};
  EXPECT_NEAR(clearance(tool, upright(16, 0, 10), pin).depth(), 2, 1e-6);
  EXPECT_NEAR(clearance(tool, upright(50, 30, 17), Mesh(scenes::box_triangles(kBlock))).depth(), 3, 1e-6);
}

/// The overlap is known to end after a translation along the plane that the scene was made with.
TEST(Clearance, StatesADepthThatIsNearlyAlwaysTheSmallest) {
  std::size_t larger = 0;
  const std::vector<std::uint64_t> seeds = support::seeds(1'000);
  for (const std::uint64_t seed : seeds) {
    Random random(seed);
    const RevolvedBody tool = body(flat_body(random.real(1, 30), random.real(10, 100)));
    const Cuboid box = scenes::any_cuboid(random);
    const scenes::Touch touch = scenes::any_touch(random, box);
    const double enough = random.real(0.001, 5);
    const AxisPlacement at = scenes::placed_at_gap(tool, scenes::any_direction(random), touch, -enough);
    const double depth = clearance(tool, at, box).depth();
    ASSERT_GT(depth, 0) << seed;
    ASSERT_LE(depth, 2 * enough) << seed;
    larger += depth > enough + 1e-3 ? 1 : 0;
  }
  EXPECT_LE(larger, seeds.size() / 20);
}

/// How far a point is from a body; 0 or less within it.
double distance_from(const RevolvedBody& tool, const AxisPlacement& at, const Vec3& point) {
  double nearest = kExact;
  for (const BodyPiece& piece : tool.pieces())
    nearest = std::min(nearest, (PlacedFrustum(piece.core, at).nearest(point) - point).norm() - piece.rounding);
  return nearest;
}

TEST(Clearance, StatesAPointOfTheBodyAndOneOfTheObstacle) {
  for (const std::uint64_t seed : support::seeds(1'000)) {
    Random random(seed);
    const RevolvedBody tool = scenes::any_body(random);
    const Cuboid box = scenes::any_cuboid(random);
    const scenes::Touch touch = scenes::any_touch(random, box);
    const double gap = random.one_in(2) ? random.real(-20, 0) : random.real(0, 200);
    const AxisPlacement at = scenes::placed_at_gap(tool, scenes::any_direction(random), touch, gap);
    const Clearance found = clearance(tool, at, box);
    ASSERT_LE(distance_from(tool, at, found.on_body), 1e-6) << seed;
    ASSERT_LE((box.nearest(found.on_obstacle) - found.on_obstacle).norm(), 1e-6) << seed;
  }
}

TEST(Clearance, NeedsNoMoreThanIsSufficient) {
  const Clearance found = clearance(body(flat_body(10, 80)), upright(50, 30, 1000), kBlock, 500);
  EXPECT_GE(found.lower, 500);
  EXPECT_LE(found.lower, 980);
}

TEST(Clearance, OfAPlacementThatIsNotFiniteIsUnknown) {
  const double bad = std::numeric_limits<double>::quiet_NaN();
  const RevolvedBody tool = body(flat_body(10, 80));
  for (const AxisPlacement& at : {AxisPlacement{{bad, 0, 0}, {0, 0, 1}}, AxisPlacement{{0, 0, 0}, {0, bad, 1}}}) {
    EXPECT_LT(clearance(tool, at, kBlock).lower, -1e300);
    EXPECT_GT(clearance(tool, at, kBlock).upper, 1e300);
    EXPECT_LT(clearance(tool, at, Mesh(scenes::box_triangles(kBlock))).lower, -1e300);
  }
}

/// A cylinder and a mesh can be moved rigidly with the body; the distance stays.
TEST(Clearance, DoesNotDependOnTheFrame) {
  for (const std::uint64_t seed : support::seeds(1'000)) {
    Random random(seed);
    const RevolvedBody tool = scenes::any_body(random);
    const Cylinder pin = scenes::any_cylinder(random);
    const Eigen::AngleAxisd turn(random.real(-3, 3), scenes::any_direction(random));
    const Vec3 shift = scenes::any_point(random, 500);
    const auto moved = [&](const AxisPlacement& at) {
      return AxisPlacement{turn * at.origin + shift, (turn * at.axis).normalized()};
    };
    const AxisPlacement at{scenes::any_point(random, 400), scenes::any_direction(random)};
    const Clearance here = clearance(tool, at, pin);
    const Clearance there = clearance(tool, moved(at), Cylinder{moved(pin.at), pin.height, pin.radius});
    if (here.lower > 0) {
      ASSERT_NEAR(here.lower, there.lower, 2e-7) << seed;
    }
    ASSERT_EQ(here.upper < 0, there.upper < 0) << seed;
  }
}

/// A larger body is never further away, nor a larger obstacle.
TEST(Clearance, DoesNotGrowWithTheBody) {
  for (const std::uint64_t seed : support::seeds(1'000)) {
    Random random(seed);
    const double radius = random.real(1, 30);
    const double length = random.real(10, 100);
    const AxisPlacement at{scenes::any_point(random, 400), scenes::any_direction(random)};
    const Cuboid box = scenes::any_cuboid(random);
    const double small = clearance(body(flat_body(radius, length)), at, box).lower;
    if (small <= 0) continue;
    ASSERT_LE(clearance(body(flat_body(radius + 1, length)), at, box).lower, small + 2e-7);
    ASSERT_LE(clearance(body(flat_body(radius, length + 1)), at, box).lower, small + 2e-7);
    const Cuboid larger{box.minimum - Vec3(1, 1, 1), box.maximum};
    ASSERT_LE(clearance(body(flat_body(radius, length)), at, larger).lower, small + 2e-7);
  }
}

/// A body that is deep in a mesh is no nearer to free for being thin, and its depth grows on where all of it is inside.
TEST(Clearance, OfAMeshGrowsWithTheDepth) {
  const Cuboid block{{-100, -100, -80}, {100, 100, 0}};
  const Mesh mesh(scenes::box_triangles(block));
  for (const double depth : {0.5, 4.0, 10.0, 30.0, 39.0})
    for (const double length : {20.0, 100.0})
      for (const RevolvedBody& tool : {body(flat_body(5, length)), body(ball_body(5, length))})
        EXPECT_NEAR(clearance(tool, upright(0, 0, -depth), mesh).upper, -depth, kExactly) << depth << " " << length;
  // Through all of it: out to the side.
  EXPECT_NEAR(clearance(body(flat_body(5, 200)), upright(0, 0, -120), mesh).upper, -105, kExactly);
}

/// Of two parts in one mesh, which are not convex together, the depth is that of the deepest point of a body, on any
/// side of it.
TEST(Clearance, OfAMeshIsThatOfTheDeepestPoint) {
  std::vector<Triangle> triangles = scenes::box_triangles({{-200, -200, -200}, {200, 200, 200}});
  for (const Triangle& triangle : scenes::box_triangles({{500, 0, 0}, {501, 1, 1}})) triangles.push_back(triangle);
  const Mesh parts(std::move(triangles));
  for (const double depth : {8.0, 30.0})
    EXPECT_NEAR(clearance(body(flat_body(5, 200)), upright(0, 0, 200 - depth), parts).upper, -depth, kExactly);
  for (const Vec3& side : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0)})
    EXPECT_NEAR(clearance(body(disc_body(50, 4)), {(200 + 50 - 70) * side, {0, 0, 1}}, parts).upper, -70, kExactly)
        << side.transpose();
}

/// How far all of a tool must go back, whichever of its pieces is deepest, in a box and in its mesh.
TEST(Clearance, OfAToolIsThatOfAllItsPieces) {
  const Cuboid block{{-100, -100, -80}, {100, 100, 0}};
  const std::vector<StackRow> rows = {{6, 10, 20}, {30, 20, 20}, {30, 50, 50}};
  for (const RevolvedBody& tool :
       {body(drill_body(5, 118, 60)), body(ball_body(10, 60)), body(bull_body(6, 2, 60)), body(cone_body(8, 1, 60, 60)),
        body(stacked_body(rows, 0)), body(form_body(std::vector<FormPoint>{{0, 0}, {4, 8}, {9, 3}, {20, 6}, {60, 6}}))})
    for (const double depth : {1.0, 5.0, 17.0, 40.0}) {
      EXPECT_NEAR(clearance(tool, upright(0, 0, -depth), block).upper, -depth, kExactly) << depth;
      EXPECT_NEAR(clearance(tool, upright(0, 0, -depth), Mesh(scenes::box_triangles(block))).upper, -depth, kExactly);
    }
  // The neck is in a plate that the wider end is below: the end must come out as well.
  const std::vector<FormPoint> hook = {{0, 8}, {4, 8}, {4, 3}, {60, 3}};
  EXPECT_NEAR(clearance(body(form_body(hook)), upright(0, 0, -30), Cuboid{{-100, -100, -20}, {100, 100, 0}}).upper, -30,
              kExactly);
}

/// A tool on a straight way comes as near as in the nearest of many places on it.
TEST(Clearance, OfAWayIsThatOfItsNearestPlace) {
  for (const std::uint64_t seed : support::seeds(600)) {
    Random random(seed);
    const RevolvedBody tool = scenes::any_body(random);
    const AxisPlacement from{scenes::any_point(random, 400), scenes::any_direction(random)};
    const Vec3 way = scenes::any_point(random, 200);
    const Cuboid box = scenes::any_cuboid(random);
    const Cylinder pin = scenes::any_cylinder(random);
    const Mesh ball(scenes::bumpy_ball(scenes::any_point(random, 200), random.real(5, 100), 6, 0.05));
    const auto expect_nearest = [&](const auto& obstacle) {
      constexpr int kPlaces = 200;
      double nearest = kExact;
      for (int i = 0; i <= kPlaces; ++i)
        nearest = std::min(nearest, clearance(tool, {from.origin + way * i / kPlaces, from.axis}, obstacle).lower);
      const double found = way_clearance(tool, from, way, obstacle, kExact);
      ASSERT_LE(found, std::max(nearest, 0.0) + kExactly) << seed;
      if (nearest > 0 && !(found <= 0)) {
        ASSERT_GE(found, nearest - way.norm() / kPlaces / 2 - kExactly) << seed;
      }
      const double enough = random.real(0, 100);
      ASSERT_EQ(way_clearance(tool, from, way, obstacle, enough) >= enough, found >= enough) << seed;
    };
    expect_nearest(box);
    expect_nearest(pin);
    if (!ball.encloses(from.at(tool.middle()))) expect_nearest(ball);
    if (testing::Test::HasFatalFailure()) return;
  }
}

/// Of a part that is not convex, the depth across an upright edge is that of the edge, though the faces beside it reach
/// deeper into the cutter.
TEST(Clearance, OfAMeshIsMeasuredAcrossItsEdges) {
  const auto part = scenes::prism({{0, 0}, {0, 50}, {-50, 50}, {-50, -50}, {100, -50}, {100, 0}}, 200);
  const RevolvedBody tool = body(flat_body(9, 300));
  for (const double depth : {0.05, 0.2, 1.0})
    for (const double below : {0.02, 0.1, 0.5, 1.5, 3.0, 20.0}) {
      const double aside = (9 - depth) / std::numbers::sqrt2;
      EXPECT_NEAR(clearance(tool, upright(100 + aside, -aside, -below), *part).upper, -std::min(depth, below), 1e-4)
          << depth << ", " << below;
    }
}

/// Of a pin that ends outside on both sides, the depth is that of its middle. It stands where edges of triangles cross,
/// above and below: it is easily free of each of these.
TEST(Clearance, OfAPinThroughAMeshIsThatOfItsMiddle) {
  // A floor of 20 mm with a wall on one side.
  const auto part = scenes::prism({{0, 0}, {200, 0}, {200, 20}, {40, 20}, {40, 100}, {0, 100}}, 200);
  const RevolvedBody pin = body(flat_body(1, 72));
  EXPECT_NEAR(clearance(pin, upright(1000.0 / 9, 1000.0 / 9, -50), *part).upper, -(20 - 22.0 / 2), 1e-4);
}

/// A cylinder in a triangle is free at the latest after a way across the triangle's plane, or across one of its edges
/// and the axis.
TEST(Clearance, OfATriangleIsAtMostTheWayAcrossAnEdge) {
  for (const std::uint64_t seed : support::seeds(3'000)) {
    Random random(seed);
    const RevolvedBody tool = body(flat_body(random.real(1, 10), random.real(2, 100)));
    const Triangle triangle{
        {scenes::any_point(random, 40), scenes::any_point(random, 40), scenes::any_point(random, 40)}};
    const AxisPlacement at{scenes::any_point(random, 40), scenes::any_direction(random)};
    double least = kExact;
    const auto consider = [&](const Vec3& direction) {
      for (const Vec3& n : {Vec3(direction.normalized()), Vec3(-direction.normalized())})
        least = std::min(least, n.dot(scenes::farthest_point(tool, at, n)) - triangle.lowest(n));
    };
    consider(triangle.area_vector());
    for (std::size_t i = 0; i < 3; ++i) consider(at.axis.cross(triangle.corners[(i + 1) % 3] - triangle.corners[i]));
    ASSERT_LE(clearance(tool, at, Mesh({triangle})).depth(), std::max(least, 0.0) + kExactly) << seed;
  }
}

/// A mesh of a box is as far away as the box.
TEST(Clearance, OfAMeshIsThatOfTheSolid) {
  for (const std::uint64_t seed : support::seeds(500)) {
    Random random(seed);
    const RevolvedBody tool = scenes::any_body(random);
    const Cuboid box = scenes::any_cuboid(random);
    const AxisPlacement at{scenes::any_point(random, 400), scenes::any_direction(random)};
    const Clearance solid = clearance(tool, at, box);
    const Clearance mesh = clearance(tool, at, Mesh(scenes::box_triangles(box)));
    if (solid.lower > 0) {
      ASSERT_NEAR(solid.lower, mesh.lower, 1e-6) << seed;
    }
    ASSERT_EQ(solid.upper <= 0, mesh.upper <= 0) << seed;
    if (solid.upper < 0) {
      ASSERT_NEAR(solid.upper, mesh.upper, 1e-3) << seed;
    }
  }
}

}  // namespace
}  // namespace isocnc::solids
