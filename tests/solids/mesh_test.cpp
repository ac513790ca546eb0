#include "interpreter/solids/mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "interpreter/geometry/frame.h"
#include "scenes.h"

namespace isocnc::solids {
namespace {

using scenes::Random;
using scenes::Vec3;

const Cuboid kBrick{{-10, -20, -30}, {10, 20, 30}};

TEST(Triangles, HaveTheirNearestPointInTheFaceOnAnEdgeOrAtACorner) {
  const Triangle triangle{{Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 3, 0)}};
  const auto expect_nearest = [&](const Vec3& point, const Vec3& expected) {
    EXPECT_LT((triangle.nearest(point) - expected).norm(), 1e-12) << point.transpose();
  };
  expect_nearest({1, 1, 5}, {1, 1, 0});
  expect_nearest({2, -1, 1}, {2, 0, 0});
  expect_nearest({-1, 1, -1}, {0, 1, 0});
  // Across 3 x + 4 y = 12, whose normal is (3, 4) / 5.
  expect_nearest({4, 3, 2}, Vec3(4, 3, 0) - 12.0 / 5 * Vec3(3, 4, 0) / 5);
  expect_nearest({-2, -1, 3}, {0, 0, 0});
  expect_nearest({9, -1, 0}, {4, 0, 0});
  expect_nearest({-1, 8, 0}, {0, 3, 0});
}

TEST(Triangles, AreMovedWithAllTheirCorners) {
  const Triangle moved = Triangle{{Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 3, 0)}}.moved({1, 2, 5});
  EXPECT_EQ(moved.corners[0], Vec3(1, 2, 5));
  EXPECT_EQ(moved.corners[1], Vec3(5, 2, 5));
  EXPECT_EQ(moved.corners[2], Vec3(1, 5, 5));
}

TEST(MeshTopology, OfABoxIsClosedAndFacesOutwards) {
  const MeshTopology topology = topology_of(scenes::box_triangles(kBrick));
  EXPECT_TRUE(topology.is_closed());
  EXPECT_TRUE(topology.faces_outwards());
  EXPECT_NEAR(topology.volume, 20 * 40 * 60, 1e-9);
}

TEST(MeshTopology, OfABoxTurnedInsideOutIsClosedButFacesInwards) {
  std::vector<Triangle> triangles = scenes::box_triangles(kBrick);
  for (Triangle& triangle : triangles) std::swap(triangle.corners[0], triangle.corners[1]);
  const MeshTopology topology = topology_of(triangles);
  EXPECT_TRUE(topology.is_closed());
  EXPECT_FALSE(topology.faces_outwards());
}

TEST(MeshTopology, CountsOpenEdges) {
  std::vector<Triangle> triangles = scenes::box_triangles(kBrick);
  triangles.pop_back();
  EXPECT_EQ(topology_of(triangles).open_edges, 3U);
  triangles = scenes::box_triangles(kBrick);
  std::swap(triangles[0].corners[0], triangles[0].corners[1]);  // One triangle that faces the other way.
  EXPECT_EQ(topology_of(triangles).open_edges, 6U);
  EXPECT_FALSE(topology_of(triangles).is_closed());
}

/// A sliver in an edge, as CAD systems write them, closes what would be open without it.
TEST(MeshTopology, CountsDegenerateTrianglesAndKeepsTheirEdges) {
  const Vec3 a(0, 0, 0);
  const Vec3 b(4, 0, 0);
  const Vec3 middle(2, 0, 0);
  const Vec3 c(0, 4, 0);
  const Vec3 top(0, 0, 4);
  const std::vector<Triangle> triangles = {{{a, c, middle}}, {{middle, c, b}}, {{a, b, top}},
                                           {{b, c, top}},    {{c, a, top}},    {{a, middle, b}}};
  const MeshTopology topology = topology_of(triangles);
  EXPECT_EQ(topology.degenerate, 1U);
  EXPECT_TRUE(topology.is_closed());
}

TEST(Mesh, EnclosesWhatIsInside) {
  const Mesh mesh(scenes::bumpy_ball(Vec3(5, 6, 7), 20, 16, 0.1));
  ASSERT_TRUE(mesh.topology().faces_outwards());
  Random random(1);
  int inside = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 offset = scenes::any_point(random, 25);
    if (offset.norm() > 17.5 && offset.norm() < 22.5) continue;  // Where the bumps are.
    ASSERT_EQ(mesh.encloses(Vec3(5, 6, 7) + offset), offset.norm() < 20) << offset.transpose();
    inside += offset.norm() < 20 ? 1 : 0;
  }
  EXPECT_GT(inside, 200);
}

/// Rays that run through corners and along edges and faces.
TEST(Mesh, EnclosesPointsBelowCornersAndEdges) {
  std::vector<Triangle> triangles = scenes::box_triangles(kBrick);
  for (const Triangle& triangle : scenes::box_triangles({{10, -20, -30}, {12, 20, 30}})) triangles.push_back(triangle);
  const Mesh mesh(std::move(triangles));
  for (const double x : {-9.0, 0.0, 9.0})
    for (const double y : {-10.0, 0.0, 10.0}) EXPECT_TRUE(mesh.encloses(Vec3(x, y, x * 3 + y / 9))) << x << " " << y;
  for (const double z : {-40.0, 40.0})
    for (const double x : {-10.0, 0.0, 10.0, 12.0})
      for (const double y : {-20.0, 0.0, 20.0}) EXPECT_FALSE(mesh.encloses(Vec3(x, y, z))) << x << " " << y << " " << z;
  EXPECT_FALSE(mesh.encloses(Vec3(13, 0, 0)));
}

TEST(Mesh, KeepsAllTrianglesWithinTheBoxesOfItsTree) {
  const std::vector<Triangle> triangles = scenes::bumpy_ball(Vec3(0, 0, 0), 50, 20, 0.1);
  const Mesh mesh(triangles);
  std::size_t found = 0;
  for (const MeshNode& node : mesh.nodes())
    for (std::uint32_t i = 0; i < node.count; ++i, ++found)
      EXPECT_TRUE(node.box.contains(mesh.triangles()[node.first + i].bounds()));
  EXPECT_EQ(found, triangles.size());
  EXPECT_LE(mesh.nodes().size(), triangles.size());
}

/// As many equal triangles as one likes are no deep tree.
TEST(Mesh, SplitsEqualTriangles) {
  const Mesh mesh(std::vector<Triangle>(10'000, Triangle{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}}));
  const RevolvedBody tool = scenes::body(flat_body(1, 10));
  EXPECT_NEAR(clearance(tool, {{0, 0, 2}, {0, 0, 1}}, mesh).lower, 2, 2e-6);
}

/// The corners as an STL file has them: in single precision.
std::vector<Triangle> rounded_to_float(std::vector<Triangle> triangles, const geometry::Mat3& turn, const Vec3& shift) {
  for (Triangle& triangle : triangles)
    for (Vec3& corner : triangle.corners) corner = (turn * corner + shift).cast<float>().cast<double>();
  return triangles;
}

TEST(Mesh, IsConvexAlsoWhereItsFileHasRoundedItsCorners) {
  const geometry::Mat3 oblique =
      (Eigen::AngleAxisd(0.35, Vec3::UnitZ()) * Eigen::AngleAxisd(0.35, Vec3::UnitX())).toRotationMatrix();
  const std::vector<Triangle> box = rounded_to_float(scenes::box_triangles(kBrick), oblique, {1234.5, -987.6, 55.5});
  EXPECT_NE(Mesh(box).convex(), nullptr);
  // Not where a corner that faces meet in stands 0.05 mm deeper.
  std::vector<Triangle> bent = box;
  const Vec3 corner = bent.front().corners[0];
  const Vec3 middle(1234.5, -987.6, 55.5);
  for (Triangle& triangle : bent)
    for (Vec3& each : triangle.corners)
      if (each == corner) each += 0.05 * (middle - corner).normalized();
  EXPECT_EQ(Mesh(bent).convex(), nullptr);
}

/// A corner of the upper face stands above the triangle beside it by so much.
TEST(Mesh, IsConvexToWithinTwoMicrometers) {
  for (const double above : {0.0018, 0.0022}) {
    std::vector<Triangle> plate = scenes::box_triangles({{0, 0, 0}, {1600, 1600, 20}});
    for (Triangle& triangle : plate)
      for (Vec3& corner : triangle.corners)
        if (corner.z() == 20 && corner.x() == corner.y()) corner.z() -= above / 2;
    EXPECT_EQ(Mesh(plate).convex() != nullptr, above < 0.002) << above;
  }
}

TEST(Mesh, TurnedInsideOutIsTheSameConvexSolid) {
  std::vector<Triangle> triangles = scenes::box_triangles(kBrick);
  for (Triangle& triangle : triangles) std::swap(triangle.corners[0], triangle.corners[1]);
  const Mesh mesh(triangles);
  ASSERT_NE(mesh.convex(), nullptr);
  const ConvexSolid& solid = *mesh.convex();
  ASSERT_EQ(solid.normals.size(), 6U);
  const Vec3 half = kBrick.maximum;
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(solid.normals[i].norm(), 1, 1e-12);
    EXPECT_NEAR(solid.heights[i], solid.normals[i].cwiseAbs().dot(half), 1e-12) << "outwards";
  }
}

TEST(Mesh, IsConvexWithAsManySidesAsACylinderHas) {
  constexpr int kSides = 96;
  const auto rim = [](int i, double z) {
    const double angle = 2 * std::numbers::pi * (i % kSides) / kSides;
    return Vec3(40 * std::cos(angle), 40 * std::sin(angle), z);
  };
  std::vector<Triangle> triangles;
  for (int i = 0; i < kSides; ++i) {
    triangles.push_back({{rim(i, 0), rim(i + 1, 0), rim(i + 1, 50)}});
    triangles.push_back({{rim(i, 0), rim(i + 1, 50), rim(i, 50)}});
    if (i < 2) continue;
    triangles.push_back({{rim(0, 50), rim(i - 1, 50), rim(i, 50)}});
    triangles.push_back({{rim(0, 0), rim(i, 0), rim(i - 1, 0)}});
  }
  for (Triangle& triangle : triangles)
    for (Vec3& corner : triangle.corners) corner = corner.cast<float>().cast<double>();
  EXPECT_NE(Mesh(triangles).convex(), nullptr);
}

TEST(Mesh, ThatIsConvexHasEachFaceAndEdgeOnce) {
  const Mesh box(scenes::box_triangles(kBrick));
  EXPECT_EQ(box.convex()->normals.size(), 6U);
  EXPECT_EQ(box.convex()->edges.size(), 3U) << "of the three directions, none across a face";
  const Vec3 corner(0, 0, 0);
  const Vec3 x(4, 0, 0);
  const Vec3 y(0, 3, 0);
  const Vec3 z(0, 0, 5);
  std::vector<Triangle> pyramid = {{{corner, y, x}}, {{corner, x, z}}, {{corner, z, y}}, {{x, y, z}}};
  for (int first = 0; first < 4; ++first) {
    std::rotate(pyramid.begin(), pyramid.begin() + 1, pyramid.end());
    const Mesh mesh(pyramid);
    EXPECT_EQ(mesh.convex()->normals.size(), 4U);
    EXPECT_EQ(mesh.convex()->edges.size(), 6U);
  }
}

/// Of a face in parts, also where its inner corner is the second one in their order.
TEST(Mesh, ThatIsConvexHasNoEdgesWithinAFace) {
  const Vec3 top(0, 0, 0);
  const Vec3 a(4, -1, -1);
  const Vec3 b(4, 2, -1);
  const Vec3 c(4, 0, 3);
  const Vec3 inner = (a + b) / 8;
  const Mesh mesh({{{top, b, inner}}, {{b, a, inner}}, {{a, top, inner}}, {{top, c, b}}, {{top, a, c}}, {{a, b, c}}});
  ASSERT_NE(mesh.convex(), nullptr);
  EXPECT_EQ(mesh.convex()->normals.size(), 4U);
  EXPECT_EQ(mesh.convex()->edges.size(), 6U);
}

TEST(Mesh, HasAPointOfEachOfItsSurfaces) {
  std::vector<Triangle> apart;
  for (int i = 0; i < 5; ++i) apart.push_back({{Vec3(10 * i, 0, 0), Vec3(10 * i + 4, 0, 0), Vec3(10 * i, 3, 0)}});
  EXPECT_EQ(Mesh(apart).surface_points().size(), 5U);
}

/// A body within a closed mesh touches no triangle, and overlaps all the same.
TEST(Mesh, ThatIsClosedIsSolid) {
  const RevolvedBody tool = scenes::body(flat_body(1, 10));
  const AxisPlacement inside{{0, 0, 0}, {0, 0, 1}};
  const Mesh solid(scenes::box_triangles(kBrick));
  EXPECT_NEAR(clearance(tool, inside, solid).upper, -11, 1e-5);  // Out to the side.
  std::vector<Triangle> triangles = scenes::box_triangles(kBrick);
  triangles.pop_back();
  EXPECT_GT(clearance(tool, inside, Mesh(triangles)).lower, 0);
}

}  // namespace
}  // namespace isocnc::solids
