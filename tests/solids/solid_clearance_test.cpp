#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "interpreter/solids/clearance.h"
#include "tests/solids/expected_bounds.h"

/// Distances between two solids, one at a placement.
namespace isocnc::solids {
namespace {

using scenes::kSceneError;
using scenes::Random;
using scenes::Touch;
using scenes::Vec3;

constexpr double kBoundsAgree = 2 * kRounding;

Placement shifted(double x, double y, double z) {
  Placement at = Placement::Identity();
  at.translation() = Vec3(x, y, z);
  return at;
}

Placement turned(double angle, const Vec3& axis, const Vec3& shift) {
  Placement at = Placement::Identity();
  at.linear() = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  at.translation() = shift;
  return at;
}

Cylinder moved(const Cylinder& cylinder, const Placement& by) {
  return {.at = {by * cylinder.at.origin, by.linear() * cylinder.at.axis},
          .height = cylinder.height,
          .radius = cylinder.radius};
}

Mesh moved(const Mesh& mesh, const Placement& by) {
  std::vector<Triangle> triangles(mesh.triangles().begin(), mesh.triangles().end());
  for (Triangle& triangle : triangles)
    for (Vec3& corner : triangle.corners) corner = by * corner;
  return Mesh(std::move(triangles));
}

Mesh mesh_of(const Cuboid& box) { return Mesh(scenes::box_triangles(box)); }

const Cuboid kPlate{{0, 0, 0}, {100, 60, 20}};
const Cuboid kCube{{-10, -10, -10}, {10, 10, 10}};

TEST(SolidClearance, OfBoxesIsThatOfTheirFacesEdgesAndCorners) {
  EXPECT_NEAR(clearance(kCube, shifted(50, 30, 37), kPlate).lower, 7, kBoundsAgree);
  EXPECT_NEAR(clearance(kCube, shifted(113, 74, 5), kPlate).lower, 5, kBoundsAgree);
  EXPECT_NEAR(clearance(kCube, shifted(112, 73, 34), kPlate).lower, std::sqrt(4 + 9 + 16.0), kBoundsAgree);
  // An edge of the cube, turned by 45 degrees, above the face.
  const Clearance above = clearance(kCube, turned(std::numbers::pi / 4, Vec3::UnitX(), {50, 30, 40}), kPlate);
  EXPECT_NEAR(above.lower, 20 - 10 * std::sqrt(2.0), kBoundsAgree);
  EXPECT_NEAR(above.on_obstacle.z(), 20, 1e-6);
  EXPECT_NEAR(above.on_body.z(), 40 - 10 * std::sqrt(2.0), 1e-6);
}

TEST(SolidClearance, OfCrossedCylindersIsThatOfTheirAxes) {
  const Cylinder pin{.at = {{-50, 0, 0}, {1, 0, 0}}, .height = 100, .radius = 8};
  const Cylinder post{.at = {{0, 0, -50}, {0, 0, 1}}, .height = 100, .radius = 10};
  EXPECT_NEAR(clearance(post, shifted(0, 30, 0), pin).lower, 30 - 8 - 10, kBoundsAgree);
  EXPECT_NEAR(clearance(post, shifted(0, 15, 0), pin).depth(), 3, 1e-6);
}

TEST(SolidClearance, IsMinusTheDepthOfAnOverlap) {
  EXPECT_NEAR(clearance(kCube, shifted(50, 30, 27), kPlate).upper, -3, 1e-6);
  EXPECT_NEAR(clearance(mesh_of(kCube), shifted(50, 30, 27), kPlate).upper, -3, 1e-6);
  EXPECT_NEAR(clearance(kCube, shifted(50, 30, 27), mesh_of(kPlate)).upper, -3, 1e-6);
  EXPECT_LE(clearance(mesh_of(kCube), shifted(50, 30, 27), mesh_of(kPlate)).upper, 0);
}

TEST(SolidClearance, OfSmallBoxesIsTheirDepth) {
  const Cuboid crumb{{-0.2, -0.2, -0.2}, {0.2, 0.2, 0.2}};
  EXPECT_NEAR(clearance(crumb, shifted(0, 0, 0.1), crumb).upper, -0.3, 1e-6);
  EXPECT_NEAR(clearance(crumb, shifted(0.01, 0.02, -0.3), crumb).upper, -0.1, 1e-6);
}

TEST(SolidClearance, OfAPlacementThatIsNotFiniteIsUnknown) {
  const Cylinder pin{.at = {}, .height = 10, .radius = 8};
  const auto expect_unknown = [](const Clearance& found) {
    EXPECT_LT(found.lower, -1e300);
    EXPECT_GT(found.upper, 1e300);
  };
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Placement skewed = Placement::Identity();
    skewed.linear()(1, 2) = bad;
    for (const Placement& at : {shifted(bad, 0, 0), shifted(0, 0, -bad), skewed}) {
      expect_unknown(clearance(kCube, at, kPlate));
      expect_unknown(clearance(pin, at, kPlate, 0.0));
      expect_unknown(clearance(mesh_of(kCube), at, pin));
      expect_unknown(clearance(mesh_of(kCube), at, mesh_of(kPlate)));
    }
  }
}

TEST(SolidClearance, NeedsNoMoreThanIsSufficient) {
  const Clearance found = clearance(kCube, shifted(50, 30, 1000), kPlate, 500);
  EXPECT_GE(found.lower, 500);
  EXPECT_LE(found.lower, 970);
}

TEST(SolidClearance, WhatAClosedMeshEnclosesOverlapsIt) {
  const Mesh hall = mesh_of({{-100, -100, -100}, {100, 100, 100}});
  const Cylinder pin{.at = {{0, 0, -10}, {0, 0, 1}}, .height = 20, .radius = 10};
  for (const double sufficient : {kExact, 5.0}) {
    EXPECT_NEAR(clearance(kCube, shifted(60, 0, 0), hall, sufficient).upper, -30, 1e-5);
    EXPECT_NEAR(clearance(kCube, shifted(60, 0, 0), hall, sufficient).lower, -30, 1e-5);
    EXPECT_NEAR(clearance(pin, shifted(60, 0, 0), hall, sufficient).upper, -30, 1e-5);
    EXPECT_NEAR(clearance(mesh_of(kCube), shifted(60, 0, 0), hall, sufficient).upper, -30, 1e-5);
    // The moving mesh encloses the obstacle.
    EXPECT_NEAR(clearance(hall, shifted(-60, 0, 0), kCube, sufficient).upper, -30, 1e-5);
    EXPECT_NEAR(clearance(hall, shifted(-60, 0, 0), pin, sufficient).upper, -30, 1e-5);
    EXPECT_NEAR(clearance(hall, shifted(-60, 0, 0), mesh_of(kCube), sufficient).upper, -30, 1e-5);
  }
  EXPECT_LT(clearance(hall, shifted(0, 0, 0), Cuboid{{-500, -500, -500}, {500, 500, 500}}).upper, 0);
}

TEST(SolidClearance, OneEnclosedSurfaceOfSeveralIsEnough) {
  std::vector<Triangle> both = scenes::box_triangles({{500, 0, 0}, {520, 20, 20}});
  const std::vector<Triangle> inner = scenes::box_triangles(kCube);
  both.insert(both.end(), inner.begin(), inner.end());
  const Mesh pair(std::move(both));
  EXPECT_EQ(pair.surface_points().size(), 2u);
  const Mesh hall = mesh_of({{-100, -100, -100}, {100, 100, 100}});
  EXPECT_NEAR(clearance(pair, shifted(0, 0, 0), hall).upper, -90, 1e-5);
  EXPECT_NEAR(clearance(hall, shifted(0, 0, 0), pair).upper, -90, 1e-5);
  EXPECT_NEAR(clearance(pair, shifted(-250, 0, 0), hall).upper, 140, 1e-5);
}

template <class Moving, class Obstacle>
void expect_known_distance(Random& random, const Moving& moving, const Obstacle& obstacle) {
  const double gap = random.one_in(2) ? random.real(-0.1, 0.1) : random.real(0, 200);
  const Placement at =
      scenes::placed_at_gap(random, scenes::any_touch(random, moving), scenes::any_touch(random, obstacle), gap);
  scenes::expect_bounds(random, gap, [&](double sufficient) { return clearance(moving, at, obstacle, sufficient); });
}

std::vector<Mesh> any_meshes() {
  Random random(7);
  std::vector<Mesh> meshes;
  for (int i = 0; i < 8; ++i) {
    meshes.emplace_back(scenes::box_triangles(scenes::any_cuboid(random)));
    meshes.emplace_back(scenes::bumpy_ball(scenes::any_point(random, 200), random.real(5, 100), 4 + 2 * i, 0.05));
  }
  return meshes;
}

/// Calls `check` with the generator and two solids of all kinds.
template <class Check>
void for_any_pair(std::uint64_t count, Check&& check) {
  const std::vector<Mesh> meshes = any_meshes();
  for (const std::uint64_t seed : support::seeds(count)) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const auto with_any = [&](auto&& use) {
      const int kind = random.between(0, 6);
      if (kind < 3) return use(scenes::any_cuboid(random));
      if (kind < 6) return use(scenes::any_cylinder(random));
      use(meshes[random.below(meshes.size())]);
    };
    with_any([&](const auto& moving) { with_any([&](const auto& obstacle) { check(random, moving, obstacle); }); });
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(SolidClearanceProperty, BoundsTheKnownDistance) {
  for_any_pair(20'000, [](Random& random, const auto& moving, const auto& obstacle) {
    expect_known_distance(random, moving, obstacle);
  });
}

TEST(SolidClearanceProperty, BoundsTheKnownDistanceOfMeshes) {
  const std::vector<Mesh> meshes = any_meshes();
  for (const std::uint64_t seed : support::seeds(1'000)) {
    SCOPED_TRACE(seed);
    Random random(seed);
    expect_known_distance(random, meshes[random.below(meshes.size())], meshes[random.below(meshes.size())]);
    if (testing::Test::HasFatalFailure()) return;
  }
}

/// Faces that are parallel but for an angle of any smallness: both bounds agree, and the corners bound the gap.
TEST(SolidClearanceProperty, HoldsForNearlyParallelFaces) {
  for (const std::uint64_t seed : support::seeds(10'000)) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Cuboid box = scenes::any_cuboid(random);
    const Cuboid other = scenes::any_cuboid(random);
    const double angle = std::pow(10, random.real(-12, -1));
    const double gap = std::pow(10, random.real(-4, 2));
    Placement at = turned(angle, scenes::any_direction(random), Vec3::Zero());
    double lowest = std::numeric_limits<double>::infinity();
    for (const Triangle& triangle : scenes::box_triangles(other))
      for (const Vec3& corner : triangle.corners) lowest = std::min(lowest, (at * corner).z());
    const Vec3 above = box.middle() - at * other.middle();
    at.translation() = Vec3(above.x(), above.y(), box.maximum.z() + gap - lowest);
    const Clearance found = clearance(other, at, box);
    ASSERT_LE(found.upper - found.lower, 10 * kRounding) << angle << " " << gap;
    ASSERT_GE(found.upper, gap - kSceneError);
    ASSERT_GE(found.lower, gap - 10 * kRounding);
  }
}

/// The depth of two boxes by the directions that can be the shortest: normals, and across two edges.
double depth_by_axes(const Cuboid& moving, const Placement& at, const Cuboid& obstacle) {
  double depth = std::numeric_limits<double>::infinity();
  const Vec3 between = at * moving.middle() - obstacle.middle();
  const Vec3 half = (moving.maximum - moving.minimum) / 2;
  const Vec3 other_half = (obstacle.maximum - obstacle.minimum) / 2;
  const auto consider = [&](const Vec3& direction) {
    if (direction.norm() < 1e-6) return;
    const Vec3 n = direction.normalized();
    double reach = -std::abs(n.dot(between));
    for (int i = 0; i < 3; ++i) reach += half[i] * std::abs(n.dot(at.linear().col(i))) + other_half[i] * std::abs(n[i]);
    depth = std::min(depth, reach);
  };
  for (int i = 0; i < 3; ++i) {
    consider(Vec3::Unit(i));
    consider(at.linear().col(i));
    for (int j = 0; j < 3; ++j) consider(Vec3::Unit(i).cross(at.linear().col(j)));
  }
  return depth;
}

TEST(SolidClearanceProperty, DepthOfBoxesIsTheShortestTranslation) {
  int overlapping = 0;
  for (const std::uint64_t seed : support::seeds(5'000)) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Cuboid moving = scenes::any_cuboid(random);
    const Cuboid obstacle = scenes::any_cuboid(random);
    Placement at = scenes::any_placement(random, 0);
    at.translation() = obstacle.middle() - at.linear() * moving.middle() + scenes::any_point(random, 150);
    const double depth = depth_by_axes(moving, at, obstacle);
    const Clearance found = clearance(moving, at, obstacle);
    ASSERT_EQ(depth > 0, found.upper <= 0) << depth;
    if (depth <= 0) continue;
    ++overlapping;
    ASSERT_NEAR(found.depth(), depth, 1e-6);
  }
  if (support::kTriesAll) {
    EXPECT_GT(overlapping, 500);
  }
}

/// The overlap is known to end after a translation along the plane that the scene was made with.
TEST(SolidClearanceProperty, DepthOfRoundSolidsIsNearlyAlwaysTheShortestTranslation) {
  std::uint64_t larger = 0;
  const auto examine = [&](Random& random, const auto& moving, const auto& obstacle) {
    const double enough = random.real(0.001, 0.1);
    const Placement at =
        scenes::placed_at_gap(random, scenes::any_touch(random, moving), scenes::any_touch(random, obstacle), -enough);
    larger += clearance(moving, at, obstacle).depth() > enough + 1e-3 ? 1 : 0;
  };
  const std::vector<std::uint64_t> seeds = support::seeds(2'000);
  for (const std::uint64_t seed : seeds) {
    Random random(seed);
    examine(random, scenes::any_cylinder(random), scenes::any_cylinder(random));
    examine(random, scenes::any_cylinder(random), scenes::any_cuboid(random));
    examine(random, scenes::any_cuboid(random), scenes::any_cylinder(random));
  }
  EXPECT_LE(larger, 3 * seeds.size() / 20);
}

/// Points all over the moving box: none is nearer than the lower bound, and one is nearly as near as the upper one.
TEST(SolidClearanceProperty, AgreesWithSampledPoints) {
  constexpr int kSteps = 12;
  for (const std::uint64_t seed : support::seeds(1'000)) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Cuboid moving = scenes::any_cuboid(random);
    const Cuboid obstacle = scenes::any_cuboid(random);
    const Placement at = scenes::any_placement(random, 300);
    double nearest = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= kSteps; ++i)
      for (int j = 0; j <= kSteps; ++j)
        for (int k = 0; k <= kSteps; ++k) {
          const Vec3 part = Vec3(i, j, k) / kSteps;
          const Vec3 point = at * Vec3(moving.minimum + part.cwiseProduct(moving.maximum - moving.minimum));
          nearest = std::min(
              nearest, (obstacle.minimum - point).cwiseMax(point - obstacle.maximum).cwiseMax(Vec3::Zero()).norm());
        }
    const Clearance found = clearance(moving, at, obstacle);
    const double spacing = (moving.maximum - moving.minimum).norm() / kSteps / 2;
    ASSERT_LE(found.lower, nearest);
    ASSERT_GE(std::max(found.upper, 0.0), nearest - spacing - kSceneError);
  }
}

TEST(SolidClearanceProperty, DoesNotDependOnWhichOfBothMoves) {
  for_any_pair(4'000, [](Random& random, const auto& moving, const auto& obstacle) {
    const Placement at = scenes::any_placement(random, 400);
    const Clearance found = clearance(moving, at, obstacle);
    const Clearance other = clearance(obstacle, at.inverse(), moving);
    if (found.lower > 0) {
      ASSERT_NEAR(found.lower, other.lower, kBoundsAgree);
      ASSERT_NEAR((found.on_body - found.on_obstacle).norm(), found.upper, 1e-5);
      ASSERT_NEAR((other.on_body - other.on_obstacle).norm(), other.upper, 1e-5);
    }
    ASSERT_EQ(found.upper <= 0, other.upper <= 0);
  });
}

TEST(SolidClearanceProperty, DoesNotDependOnTheFrame) {
  const std::vector<Mesh> meshes = any_meshes();
  const auto expect_same = [](Random& random, const auto& moving, const auto& obstacle) {
    const Placement at = scenes::any_placement(random, 400);
    const Placement by = scenes::any_placement(random, 500);
    const Clearance here = clearance(moving, at, obstacle);
    const Clearance there = clearance(moving, by * at, moved(obstacle, by));
    if (here.lower > 0) {
      ASSERT_NEAR(here.lower, there.lower, kBoundsAgree);
    }
    ASSERT_EQ(here.upper <= 0, there.upper <= 0);
  };
  for (const std::uint64_t seed : support::seeds(1'000)) {
    SCOPED_TRACE(seed);
    Random random(seed);
    expect_same(random, scenes::any_cuboid(random), scenes::any_cylinder(random));
    expect_same(random, scenes::any_cylinder(random), scenes::any_cylinder(random));
    expect_same(random, scenes::any_cuboid(random), meshes[random.below(4)]);
    expect_same(random, meshes[random.below(4)], scenes::any_cylinder(random));
    expect_same(random, meshes[random.below(4)], meshes[random.below(4)]);
    if (testing::Test::HasFatalFailure()) return;
  }
}

/// A mesh of a box is as far away as the box, whichever of both moves.
TEST(SolidClearanceProperty, OfAMeshIsThatOfTheSolid) {
  for (const std::uint64_t seed : support::seeds(1'000)) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Cuboid moving = scenes::any_cuboid(random);
    const Cuboid obstacle = scenes::any_cuboid(random);
    const Placement at = scenes::any_placement(random, 400);
    const Clearance solid = clearance(moving, at, obstacle);
    for (const Clearance& found : {clearance(mesh_of(moving), at, obstacle), clearance(moving, at, mesh_of(obstacle)),
                                   clearance(mesh_of(moving), at, mesh_of(obstacle))}) {
      if (solid.lower > 0) {
        ASSERT_NEAR(solid.lower, found.lower, kBoundsAgree);
        const Vec3 on_body = at.inverse() * found.on_body;
        ASSERT_LE((moving.nearest(on_body) - on_body).norm(), 1e-6) << "a point of the one that moves";
        ASSERT_LE((obstacle.nearest(found.on_obstacle) - found.on_obstacle).norm(), 1e-6) << "and one of the other";
      }
      ASSERT_EQ(solid.upper <= 0, found.upper <= 0);
    }
  }
}

}  // namespace
}  // namespace isocnc::solids
