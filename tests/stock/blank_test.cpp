#include <gtest/gtest.h>

#include "cuts.h"
#include "interpreter/solids/stl.h"
#include "tests/solids/scenes.h"

/// The stock before any cut, and what it takes.
namespace isocnc::stock::cuts {
namespace {

TEST(Blank, BoxHasItsVolumeWhateverTheSpacing) {
  for (const double spacing : {0.3, 0.5, 7.0, 1000.0}) {
    const Stock stock(box({-10, 20, -18}, {93, 81.5, 0}), spacing);
    EXPECT_NEAR(stock.volume(), 103 * 61.5 * 18, 1e-6) << spacing;
    EXPECT_LE(stock.spacing(), spacing);
  }
}

TEST(Blank, CylindersUprightAndLying) {
  const Stock upright(solids::Cylinder{.at = {{5, 5, -40}, {0, 0, 1}}, .height = 40, .radius = 30}, 0.25);
  EXPECT_NEAR(upright.volume() / (pi * 900 * 40), 1, 0.001);
  const Stock lying(solids::Cylinder{.at = {{5, 5, -40}, {1, 0, 0}}, .height = 60, .radius = 30}, 0.25);
  EXPECT_NEAR(lying.volume() / (pi * 900 * 60), 1, 0.001);
  EXPECT_NEAR(lying.intervals_at(30, 5).front().top, -10, 0.001);
}

TEST(Blank, MeshIsFilled) {
  const Vec3 center(3, 4, 5);
  const solids::Mesh ball_mesh(solids::scenes::bumpy_ball(center, 30, 60, 0));
  const Stock stock(&ball_mesh, 0.25);
  EXPECT_NEAR(stock.volume() / ball_mesh.topology().volume, 1, 0.0005);
  // Edges along the grid and through dexels: both triangles of a face share each point of their edge once.
  const solids::Mesh box_mesh(solids::scenes::box_triangles({{0, 0, 0}, {40, 40, 20}}));
  for (const double spacing : {0.5, 1.0, 4.0}) EXPECT_NEAR(Stock(&box_mesh, spacing).volume(), 32000, 0.01) << spacing;
}

/// A dexel through the edge that divides the lower face meets the upper face within a triangle.
TEST(Blank, MeshIsFilledWhereAnEdgeOfOneFaceIsAboveNoOther) {
  std::vector<solids::Triangle> triangles = solids::scenes::box_triangles({{0, 0, 0}, {40, 40, 20}});
  solids::Triangle& one = triangles[triangles.size() - 2];
  solids::Triangle& other = triangles.back();
  const Vec3 fourth = other.corners[2];
  other.corners[0] = one.corners[1];
  one.corners[2] = fourth;
  const solids::Mesh mesh(triangles);
  ASSERT_TRUE(mesh.topology().faces_outwards());
  for (const double spacing : {0.5, 1.0, 4.0}) EXPECT_NEAR(Stock(&mesh, spacing).volume(), 32000, 0.01) << spacing;
}

/// What a dexel only touches there is no material.
TEST(Blank, MeshHasNothingAtItsSharpEdges) {
  std::vector<solids::Triangle> triangles = solids::scenes::box_triangles({{0, 0, 0}, {40, 40, 10}});
  const auto wedge = solids::scenes::prism({{20.5, 15}, {10, 18}, {10, 12}}, 40);
  triangles.insert(triangles.end(), wedge->triangles().begin(), wedge->triangles().end());
  const solids::Mesh mesh(triangles);
  ASSERT_TRUE(mesh.topology().faces_outwards());
  const Stock stock(&mesh, 1);
  EXPECT_EQ(stock.tile({0, 0}).top(20, 21), std::optional(10.0F));
  EXPECT_EQ(stock.tile({0, 0}).top(20, 20), std::optional(10.0F));
  EXPECT_GT(stock.tile({0, 0}).top(20, 19), std::optional(15.0F));
}

TEST(Blank, MeshWithACavityHasTwoIntervals) {
  std::vector<solids::Triangle> triangles = solids::scenes::box_triangles({{0, 0, 0}, {40, 40, 20}});
  for (solids::Triangle triangle : solids::scenes::box_triangles({{10, 10, 5}, {30, 30, 15}})) {
    std::swap(triangle.corners[1], triangle.corners[2]);
    triangles.push_back(triangle);
  }
  const solids::Mesh mesh(triangles);
  const Stock stock(&mesh, 0.5);
  EXPECT_NEAR(stock.volume(), 32000 - 4000, 0.01);
  const std::vector<HeightInterval> intervals = stock.intervals_at(20, 20);
  ASSERT_EQ(intervals.size(), 2U);
  EXPECT_FLOAT_EQ(static_cast<float>(intervals[0].top), 5);
  EXPECT_FLOAT_EQ(static_cast<float>(intervals[1].bottom), 15);
}

TEST(Blank, MemoryIsKnownBeforehand) {
  const Blank table = box({0, 0, -18}, {3000, 1500, 0});
  EXPECT_LE(required_memory(table, 0.5), 250e6);
  EXPECT_LE(Stock(table, 0.5).memory(), 1e6) << "nothing is cut";
  EXPECT_TRUE(std::isinf(required_memory(table, 0)));
  EXPECT_TRUE(std::isinf(required_memory(box({1, 1, 0}, {1, 1, 9}), 0)));
  EXPECT_TRUE(std::isinf(required_memory(table, std::nan(""))));
  for (const double limit : {1e6, 1e8, 1e9}) {
    const double spacing = fitting_spacing(table, limit);
    EXPECT_LE(required_memory(table, spacing), limit);
    EXPECT_GT(required_memory(table, spacing / 1.2), limit);
  }
}

TEST(Blank, CutMemoryIsAsStated) {
  const Blank plate = box({0, 0, -18}, {300, 200, 0});
  Stock stock(plate, 0.5);
  const RevolvedBody tool = flat(200);
  apply(stock, line(tool, {0, 100, -3}, {300, 100, -3}));
  const double stated = required_memory(plate, 0.5);
  EXPECT_LE(static_cast<double>(stock.memory()), 1.01 * stated + 10000);
  EXPECT_GE(static_cast<double>(stock.memory()), 0.9 * stated);
}

TEST(Blank, UnusableSpacingIsRaised) {
  for (const double spacing : {0.0, -1.0, 1e-12, std::nan("")}) {
    const Stock stock(box({0, 0, 0}, {10, 1e-5, 1}), std::isnan(spacing) ? spacing : spacing);
    EXPECT_LE(stock.grid().columns, 1 << 17);
    EXPECT_GE(stock.grid().columns, 1);
  }
}

}  // namespace
}  // namespace isocnc::stock::cuts
