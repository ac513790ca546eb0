#include <gtest/gtest.h>

#include "cuts.h"
#include "interpreter/solids/mesh.h"
#include "interpreter/solids/stl.h"
#include "interpreter/stock/surface.h"

/// The surface of what remains.
namespace isocnc::stock::cuts {
namespace {

/// The surface as it is read again from the STL file.
std::vector<solids::Triangle> read_again(const Stock& stock) {
  return std::get<std::vector<solids::Triangle>>(solids::read_stl(solids::write_stl(surface_of(stock))));
}

void expect_closed(const Stock& stock) {
  const std::vector<solids::Triangle> triangles = read_again(stock);
  const solids::MeshTopology topology = solids::topology_of(triangles);
  EXPECT_EQ(topology.open_edges, 0U);
  EXPECT_EQ(topology.degenerate, 0U);
  EXPECT_NEAR(topology.volume / stock.volume(), 1, 1e-5);
}

TEST(Surface, OfABlankHasFewTriangles) {
  const Stock stock(box({0, 0, -18}, {256, 128, 0}), 0.5);
  expect_closed(stock);
  // 131,072 dexels. Two triangles and a corner of the face above and below for each cell along the border: walls are
  // not merged.
  EXPECT_LT(surface_of(stock).size(), 6500U);
}

TEST(Surface, IsClosedAfterCutsFromAllSides) {
  Stock stock(box({0, 0, -18}, {90, 70, 0}), 1);
  const RevolvedBody cutter = ball(6);
  const RevolvedBody saw = body(solids::disc_body(15, 3));
  const RevolvedBody drill = flat(4);
  apply(stock, line(cutter, {10, 10, -5}, {80, 50, -9}));
  expect_closed(stock);
  apply(stock, line(saw, {60, -10, -12}, {60, 80, -12}));
  apply(stock, line(drill, {20, 35, -40}, {20, 35, -40}, tilted(40)));
  apply(stock, line(drill, {-10, 60, -9}, {-10, 60, -9}, tilted(90)));
  apply(stock, line(drill, {70, 30, -30}, {70, 30, -30}));
  expect_closed(stock);
}

/// Blocks that touch along an edge only.
TEST(Surface, IsClosedWhereBlocksTouchAtEdges) {
  Stock stock(box({0, 0, 0}, {4, 4, 4}), 1);
  const RevolvedBody square = flat(0.6, 10);
  for (const auto& [x, y] : {std::pair(1.5, 1.5), std::pair(2.5, 2.5)})
    apply(stock, line(square, {x, y, 2}, {x, y, 2}));
  apply(stock, line(square, {1.5, 2.5, -9}, {1.5, 2.5, -8}));
  expect_closed(stock);
}

TEST(Surface, IsSmallInsideAFlatPanel) {
  Stock stock(box({0, 0, -18}, {640, 640, 0}), 0.5);  // 10 x 10 tiles of 64 mm.
  const std::size_t of_blank = surface_of(stock).size();
  // 5120 cells along the border as above, and four triangles for each of 100 tiles.
  EXPECT_LT(of_blank, 4 * 5120 + 4 * 300U);
  const RevolvedBody drill = flat(4);
  apply(stock, line(drill, {200, 200, -20}, {200, 200, -20}));
  expect_closed(stock);
  EXPECT_LT(surface_of(stock).size(), of_blank + 1000);
}

/// Faces of several sizes beside each other, in more than three rows of tiles.
TEST(Surface, IsClosedAcrossTiles) {
  Stock stock(box({0, 0, -18}, {150, 530, 0}), 1);
  const SomeSweeps source;
  stock.apply(source.make(7, 30));
  const RevolvedBody tool = flat(5);
  for (const double y : {100.0, 128.0, 256.0, 300.0, 384.0, 500.0}) {
    apply(stock, line(tool, {20, y, -7}, {140, y + 10, -7}));
    apply(stock, line(tool, {64, y - 40, -30}, {64, y - 40, -30}));
  }
  expect_closed(stock);
}

TEST(Surface, OfNothingIsEmpty) {
  Stock stock(box({0, 0, 0}, {4, 4, 4}), 1);
  const RevolvedBody tool = flat(20, 10);
  apply(stock, line(tool, {2, 2, -1}, {2, 2, -1}));
  EXPECT_EQ(stock.volume(), 0);
  EXPECT_TRUE(surface_of(stock).empty());
}

}  // namespace
}  // namespace isocnc::stock::cuts
