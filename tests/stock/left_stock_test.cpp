#include <gtest/gtest.h>

#include "cuts.h"

/// A blank that an earlier setup has left.
namespace isocnc::stock::cuts {
namespace {

Stock first_side() {
  Stock stock(box({10, 20, -18}, {310, 220, 0}), 0.7);
  const RevolvedBody pocket = flat(6);
  const RevolvedBody saw = body(solids::disc_body(15, 3));
  apply(stock, line(pocket, {40, 60, -5}, {90, 60, -5}));
  apply(stock, line(pocket, {200, 40, -30}, {200, 40, -30}));
  apply(stock, line(saw, {60, 180, -12}, {90, 200, -12}));
  return stock;
}

/// Where a point is now.
Vec3 placed(const LeftStock& left, Vec3 point) {
  if (left.is_turned_over) point = Vec3(point.x(), -point.y(), -point.z());
  for (int i = 0; i < (left.quarter_turns % 4 + 4) % 4; ++i) point = Vec3(-point.y(), point.x(), point.z());
  return point + left.shift;
}

TEST(LeftStock, HasEveryDexelHoweverItIsTurned) {
  const Stock old = first_side();
  for (const bool is_turned_over : {false, true})
    for (const int quarter_turns : {-1, 0, 1, 2, 3, 4, 5}) {
      const LeftStock left{.stock = std::make_shared<const Stock>(old),
                           .shift = {12.3, -7.7, 4},
                           .is_turned_over = is_turned_over,
                           .quarter_turns = quarter_turns};
      const Stock now(left, old.spacing());
      ASSERT_EQ(now.grid().columns, quarter_turns % 2 == 0 ? old.grid().columns : old.grid().rows);
      EXPECT_NEAR(now.volume(), old.volume(), 1e-6 * old.volume());
      for (int row = 0; row < old.grid().rows; ++row)
        for (int column = 0; column < old.grid().columns; ++column) {
          auto expected = intervals(old, column, row);
          if (is_turned_over) std::reverse(expected.begin(), expected.end());
          const Vec3 at = placed(left, {old.grid().x(column), old.grid().y(row), 0});
          const auto found = now.intervals_at(at.x(), at.y());
          ASSERT_EQ(found.size(), expected.size()) << at.transpose();
          for (std::size_t i = 0; i < found.size(); ++i) {
            const double bottom = is_turned_over ? -expected[i].top : expected[i].bottom;
            const double top = is_turned_over ? -expected[i].bottom : expected[i].top;
            ASSERT_EQ(found[i].bottom, static_cast<float>(bottom + 4)) << at.transpose();
            ASSERT_EQ(found[i].top, static_cast<float>(top + 4)) << at.transpose();
          }
        }
    }
}

TEST(LeftStock, HasItsBoundsTurned) {
  const Stock old = first_side();
  const solids::BoundingBox bounds = bounds_of(LeftStock{std::make_shared<const Stock>(old), {1, 2, 3}, true, 1});
  EXPECT_EQ(bounds.min(), Vec3(20 + 1, 10 + 2, 3));
  EXPECT_EQ(bounds.max(), Vec3(220 + 1, 310 + 2, 18 + 3));
}

TEST(LeftStock, TakesTheNearestDexelsAtAnotherSpacing) {
  const Stock old = first_side();
  const Stock now(LeftStock{.stock = std::make_shared<const Stock>(old), .shift = {100, 0, 0}}, 0.31);
  EXPECT_LE(now.spacing(), 0.31);
  EXPECT_NEAR(now.volume(), old.volume(), 1e-3 * old.volume());
  for (const Vec2& at : {Vec2(60, 60), Vec2(200, 40), Vec2(70, 186), Vec2(290, 210)}) {
    const auto expected = old.intervals_at(at.x(), at.y());
    const auto found = now.intervals_at(at.x() + 100, at.y());
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i].top, expected[i].top);
  }
}

TEST(LeftStock, StaysUniformWhereItHasNoCut) {
  Stock old(box({0, 0, -18}, {640, 640, 0}), 0.5);
  const RevolvedBody tool = flat(5);
  apply(old, line(tool, {32, 32, -5}, {40, 32, -5}));
  const Stock now(LeftStock{.stock = std::make_shared<const Stock>(old), .is_turned_over = true}, 0.5);
  EXPECT_LT(now.memory(), 300000U);  // Of 6.5 MB.
  EXPECT_FALSE(now.cut_by(32, -32)) << "the sweeps of an earlier setup have no meaning in this one";
}

TEST(LeftStock, IsCutAsAnyOther) {
  const Stock old = first_side();
  Stock now(LeftStock{.stock = std::make_shared<const Stock>(old), .is_turned_over = true}, old.spacing());
  const RevolvedBody tool = flat(6);
  // From the other side, where the pocket of 5 mm is below: 13 mm are left.
  const SweepOutcome outcome = apply(now, line(tool, {65, -60, -2}, {65, -60, -2}));
  EXPECT_NEAR(outcome.depth, 13, 1e-5);
  EXPECT_NEAR(old.intervals_at(65, 60).front().top, -5, 1e-5) << "the earlier stock stays as it was";
}

}  // namespace
}  // namespace isocnc::stock::cuts
