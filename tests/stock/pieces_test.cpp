#include <gtest/gtest.h>

#include <map>
#include <set>
#include <tuple>
#include <vector>

#include "cuts.h"
#include "interpreter/stock/pieces.h"
#include "tests/support/random.h"

/// The material divided into what hangs together.
namespace isocnc::stock::cuts {
namespace {

using support::Random;

/// An interval: row, column, number within its dexel.
using Place = std::tuple<int, int, int>;

/// The pieces by a plain flood.
std::set<std::set<Place>> flooded(const Stock& stock) {
  std::map<Place, HeightInterval> waiting;
  for (int row = 0; row < stock.grid().rows; ++row)
    for (int column = 0; column < stock.grid().columns; ++column) {
      int number = 0;
      for (const HeightInterval& z : intervals(stock, column, row)) waiting[{row, column, number++}] = z;
    }
  std::set<std::set<Place>> pieces;
  while (!waiting.empty()) {
    std::set<Place> piece;
    std::vector<std::pair<Place, HeightInterval>> open = {*waiting.begin()};
    waiting.erase(waiting.begin());
    while (!open.empty()) {
      const auto [place, z] = open.back();
      open.pop_back();
      piece.insert(place);
      const auto [row, column, number] = place;
      for (const auto& [down, right] : {std::pair(0, 1), {0, -1}, {1, 0}, {-1, 0}})
        for (auto next = waiting.lower_bound({row + down, column + right, 0});
             next != waiting.end() && std::get<0>(next->first) == row + down &&
             std::get<1>(next->first) == column + right;) {
          if (next->second.bottom < z.top && next->second.top > z.bottom) {
            open.push_back(*next);
            next = waiting.erase(next);
          } else {
            ++next;
          }
        }
    }
    pieces.insert(piece);
  }
  return pieces;
}

std::set<Place> places_of(const StockPiece& piece, const Stock& stock) {
  std::set<Place> places;
  for_each_interval(piece, [&](int column, int row, const HeightInterval& z) {
    int number = 0;
    for (const HeightInterval& each : intervals(stock, column, row)) {
      if (each.bottom == z.bottom) places.insert({row, column, number});
      ++number;
    }
  });
  return places;
}

void expect_flooded(const Stock& stock) {
  const std::vector<StockPiece> pieces = pieces_of(stock);
  std::set<std::set<Place>> found;
  double volume = 0;
  for (const StockPiece& piece : pieces) {
    found.insert(places_of(piece, stock));
    volume += piece.volume;
  }
  EXPECT_EQ(found, flooded(stock));
  EXPECT_NEAR(volume, stock.volume(), 1e-9 * volume);
}

TEST(Pieces, OfAWholeBlankAreOne) {
  const std::vector<StockPiece> pieces = pieces_of(Stock(kPlate, 0.5));
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_NEAR(pieces[0].volume, 300 * 200 * 18, 1e-6);
  EXPECT_NEAR((pieces[0].bounds.max() - Vec3(300, 200, 0)).norm(), 0, 1e-9);
  EXPECT_NEAR((pieces[0].bounds.min() - Vec3(0, 0, -18)).norm(), 0, 1e-9);
  EXPECT_FALSE(last_cut_beside(pieces[0]));
}

/// A frame around a part of 100 x 80 mm, that the fourth cut sets free.
TEST(Pieces, AppearWithTheCutThatFreesThem) {
  Stock stock(kPlate, 0.5);
  const RevolvedBody tool = flat(5);
  const std::vector<Vec3> corners = {{95, 45, -19}, {205, 45, -19}, {205, 135, -19}, {95, 135, -19}, {95, 45, -19}};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(pieces_of(stock).size(), 1U) << i;
    apply(stock, line(tool, corners[i], corners[i + 1], {0, 0, 1}, static_cast<CutTag>(10 + i)));
  }
  apply(stock, line(tool, {20, 20, -2}, {20, 20, -2}, {0, 0, 1}, 99));
  const std::vector<StockPiece> pieces = pieces_of(stock);
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_EQ(last_cut_beside(pieces[0]), 99U) << "the frame";
  const StockPiece& part = pieces[1];
  EXPECT_NEAR(part.volume, 100 * 80 * 18, 1e-3);
  EXPECT_EQ(last_cut_beside(part), 13U);
  EXPECT_NEAR((part.bounds.min() - Vec3(100, 50, -18)).norm(), 0, 1e-6);
  EXPECT_NEAR((part.bounds.max() - Vec3(200, 130, 0)).norm(), 0, 1e-6);
}

TEST(Pieces, MayLieAboveEachOther) {
  Stock stock(box({0, 0, -20}, {60, 40, 0}), 0.5);
  const RevolvedBody saw = body(solids::disc_body(100, 4));
  apply(stock, line(saw, {30, 20, -12}, {30, 20, -12}));
  const std::vector<StockPiece> pieces = pieces_of(stock);
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_NEAR(pieces[0].volume, 60 * 40 * 8.0, 0.1) << "the lower one comes first: as large as the other";
  EXPECT_NEAR(pieces[1].volume, 60 * 40 * 8.0, 0.1);
}

TEST(Pieces, ThatTouchAtCornersOrEndsAreApart) {
  Stock stock(box({0, 0, 0}, {4, 4, 4}), 1);
  const RevolvedBody square = flat(0.6, 10);
  for (int row = 0; row < 4; ++row)
    for (int column = row % 2; column < 4; column += 2)
      apply(stock, line(square, {column + 0.5, row + 0.5, -1}, {column + 0.5, row + 0.5, -1}));
  EXPECT_EQ(pieces_of(stock).size(), 8U);
  expect_flooded(stock);
}

TEST(Pieces, BeginWithTheLargest) {
  Stock stock(kPlate, 1);
  const RevolvedBody saw = flat(2, 40);
  apply(stock, line(saw, {200, -10, -20}, {200, 210, -20}));
  apply(stock, line(saw, {50, -10, -20}, {50, 210, -20}));
  const std::vector<StockPiece> pieces = pieces_of(stock);
  ASSERT_EQ(pieces.size(), 3U);
  EXPECT_NEAR(pieces[0].volume, 146 * 200 * 18, 1e-3);
  EXPECT_NEAR(pieces[1].volume, 98 * 200 * 18, 1e-3);
  EXPECT_NEAR(pieces[2].volume, 48 * 200 * 18, 1e-3);
}

/// Also of a grid that fills its tile.
TEST(Pieces, KnowACutAtAnySideOfTheGrid) {
  const RevolvedBody drill = flat(0.6, 10);
  for (const double size : {4.0, 128.0})
    for (const auto& [x, y] : {std::pair(0.5, 2.5), {size - 0.5, 2.5}, {2.5, 0.5}, {2.5, size - 0.5}}) {
      Stock stock(box({0, 0, 0}, {size, size, 4}), 1);
      apply(stock, line(drill, {x, y, 3}, {x, y, 3}, {0, 0, 1}, 7));
      const std::vector<StockPiece> pieces = pieces_of(stock);
      ASSERT_EQ(pieces.size(), 1U);
      EXPECT_EQ(last_cut_beside(pieces[0]), std::optional<CutTag>(7)) << x << ' ' << y;
    }
}

TEST(Pieces, AreThoseOfAFlood) {
  const SomeSweeps source;
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
    Stock stock(kPlate, 1);  // 3 x 2 tiles.
    stock.apply(source.make(seed, 120));
    const RevolvedBody saw = flat(2, 40);
    for (int i = 0; i < 6; ++i) {
      apply(stock, line(saw, {i * 50.0 + 20, -10, -20}, {i * 50.0 + 20, 210, -20}));
      apply(stock, line(saw, {-10, i * 35.0 + 10, -20}, {310, i * 35.0 + 10, -20}));
    }
    ASSERT_GT(pieces_of(stock).size(), 30U);
    expect_flooded(stock);
  }
}

/// Boxes of all sizes, some beside the stock, some with sides right on the lines of dexels.
TEST(Pieces, KnowWhereTheyHaveMaterial) {
  const SomeSweeps source;
  Stock stock(kPlate, 1);
  stock.apply(source.make(1, 120));
  const RevolvedBody saw = flat(2, 40);
  for (int i = 0; i < 6; ++i) apply(stock, line(saw, {i * 50.0 + 20, -10, -20}, {i * 50.0 + 20, 210, -20}));
  const std::vector<StockPiece> pieces = pieces_of(stock);
  Random random(7);
  const double first = stock.grid().first.x();
  int hits = 0;
  for (int i = 0; i < 400; ++i) {
    const StockPiece& piece = pieces[random.below(5)];  // The largest.
    const Vec3 corner(first + random.between(-20, 320), first + random.between(-20, 220), random.between(-22, 3));
    const Vec3 size(random.between(0, 1) * random.between(0, 150), random.between(0, 60), random.between(0, 6));
    const solids::BoundingBox box(corner, corner + size);
    bool is_there = false;
    for_each_interval(piece, [&](int column, int row, const HeightInterval& z) {
      const solids::BoundingBox material(Vec3(stock.grid().x(column), stock.grid().y(row), z.bottom),
                                         Vec3(stock.grid().x(column), stock.grid().y(row), z.top));
      is_there = is_there || box.intersects(material);
    });
    EXPECT_EQ(has_material_in(piece, box), is_there) << i;
    hits += is_there ? 1 : 0;
  }
  EXPECT_GT(hits, 20);
  EXPECT_LT(hits, 380);
}

TEST(Pieces, OfNothingAreNone) {
  Stock stock(box({0, 0, 0}, {4, 4, 4}), 1);
  const RevolvedBody tool = flat(20, 10);
  apply(stock, line(tool, {2, 2, -1}, {2, 2, -1}));
  EXPECT_TRUE(pieces_of(stock).empty());
}

}  // namespace
}  // namespace isocnc::stock::cuts
