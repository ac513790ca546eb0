#include <gtest/gtest.h>

#include <limits>

#include "cuts.h"
#include "tests/support/random.h"
#include "tests/support/threads.h"

/// The stock as a value: copies, questions, threads, and sweeps that make no sense.
namespace isocnc::stock::cuts {
namespace {

using support::on_threads;
using support::Random;

/// Both stocks are the same to the last bit, with the record of their cuts.
void expect_same(const Stock& one, const Stock& other) {
  expect_same_material(one, other);
  for (int row = 0; row < one.grid().rows; ++row)
    for (int column = 0; column < one.grid().columns; ++column) {
      const double x = one.grid().x(column);
      const double y = one.grid().y(row);
      ASSERT_EQ(one.cut_by(x, y), other.cut_by(x, y)) << x << ' ' << y;
    }
}

void expect_same(const std::vector<SweepOutcome>& one, const std::vector<SweepOutcome>& other) {
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].volume, other[i].volume) << i;
    EXPECT_EQ(one[i].depth, other[i].depth) << i;
    EXPECT_EQ(one[i].point, other[i].point) << i;
  }
}

TEST(Stock, IsTheSameForAnyNumberOfThreads) {
  const SomeSweeps source;
  for (const std::uint64_t seed : {1U, 2U}) {
    const std::vector<Sweep> sweeps = source.make(seed, 60);
    Stock alone(kPlate, 0.7);
    const auto outcomes = alone.apply(sweeps);
    for (const int count : {1, 2, 7}) {
      Stock together(kPlate, 0.7);
      expect_same(together.apply(sweeps, on_threads(count)), outcomes);
      expect_same(together, alone);
      if (HasFatalFailure()) return;
    }
  }
}

TEST(Stock, IsTheSameForAnyDivisionIntoCalls) {
  const SomeSweeps source;
  const std::vector<Sweep> sweeps = source.make(3, 60);
  Stock whole(kPlate, 0.7);
  const auto outcomes = whole.apply(sweeps);
  Stock divided(kPlate, 0.7);
  std::vector<SweepOutcome> of_parts;
  for (std::size_t i = 0; i < sweeps.size();) {
    const std::size_t size = std::min(i % 7 + 1, sweeps.size() - i);
    for (const SweepOutcome& outcome : divided.apply(std::span(sweeps).subspan(i, size))) of_parts.push_back(outcome);
    i += size;
  }
  expect_same(of_parts, outcomes);
  expect_same(divided, whole);
}

/// What the motion before has cut need not be looked at again, and nothing else may be left out. Short moves of one
/// tool, some of them along the grid, some back, some after a jump.
TEST(Stock, ContinuedMotionsAreTheSameForAnyDivisionIntoCalls) {
  const std::vector<RevolvedBody> tools = {flat(6, 50), ball(6, 50), body(solids::bull_body(6, 2, 50)),
                                           body(solids::drill_body(6, 118, 50)), body(solids::disc_body(6, 3))};
  for (std::size_t tool = 0; tool < tools.size(); ++tool) {
    support::Random random(tool);
    std::vector<Sweep> sweeps;
    Vec3 at(40, 40, -5);
    double heading = 0;
    for (CutTag i = 0; i < 300; ++i) {
      heading = random.one_in(8) ? random.real(0, 2 * pi) : heading + random.real(-0.5, 0.5);
      Vec3 to = at + random.real(0, 2) * Vec3(std::cos(heading), std::sin(heading), 0);
      if (random.one_in(4)) to = at + Vec3(random.between(-2, 2), random.between(-2, 2), 0);
      if (random.one_in(15)) to.z() = random.real(-8, -4);
      if (random.one_in(15)) at.x() += 0.5;
      to.head<2>() = to.head<2>().cwiseMax(20).cwiseMin(60);
      sweeps.push_back(line(tools[tool], at, to, {0, 0, 1}, i));
      at = to;
    }
    for (const double spacing : {0.5, 0.37}) {
      Stock whole(box({0, 0, -18}, {80, 80, 0}), spacing);
      const auto outcomes = whole.apply(sweeps);
      Stock divided(box({0, 0, -18}, {80, 80, 0}), spacing);
      std::vector<SweepOutcome> of_parts;
      for (const Sweep& sweep : sweeps) of_parts.push_back(apply(divided, sweep));
      expect_same(of_parts, outcomes);
      expect_same(divided, whole);
      if (HasFailure()) return;
    }
  }
}

TEST(Stock, OutcomesAddUpToWhatIsMissing) {
  const SomeSweeps source;
  Stock stock(kPlate, 0.7);
  const std::vector<Sweep> sweeps = source.make(4, 60);
  double removed = 0;
  const auto outcomes = stock.apply(sweeps);
  for (std::size_t i = 0; i < sweeps.size(); ++i)
    if (sweeps[i].purpose == SweepPurpose::Cut) removed += outcomes[i].volume;
  EXPECT_NEAR(removed / (300 * 200 * 18 - stock.volume()), 1, 1e-5);
}

TEST(Stock, CopiesAreIndependentAndShareWhatNeitherHasCut) {
  const RevolvedBody tool = flat(5);
  Stock stock(box({0, 0, -18}, {640, 640, 0}), 0.5);  // 10 x 10 tiles of 64 mm.
  apply(stock, line(tool, {32, 32, -5}, {600, 32, -5}));
  const Stock copy = stock;
  EXPECT_TRUE(stock.tiles_changed_since(copy).empty());
  EXPECT_EQ(copy.own_memory(), 0U);
  apply(stock, line(tool, {100, 100, -5}, {110, 100, -5}, {0, 0, 1}, 7));
  EXPECT_NEAR(stock.intervals_at(100, 100).front().top, -5, 1e-6);
  EXPECT_NEAR(copy.intervals_at(100, 100).front().top, 0, 1e-6);
  EXPECT_EQ(stock.tiles_changed_since(copy), std::vector<TileIndex>({TileIndex{1, 1}}));
  EXPECT_EQ(copy.tiles_changed_since(stock), std::vector<TileIndex>({TileIndex{1, 1}}));
  // One tile, with its node.
  EXPECT_LE(stock.own_memory(), 140000U);
  EXPECT_GE(stock.own_memory(), 128U * 1024);
}

TEST(Stock, VisitsTheDexelsThatDiffer) {
  const RevolvedBody tool = flat(5);
  const RevolvedBody saw = body(solids::disc_body(15, 3));
  Stock now(box({0, 0, -18}, {640, 640, 0}), 0.5);
  apply(now, line(tool, {32, 32, -5}, {600, 32, -5}));
  const Stock old = now;
  apply(now, line(tool, {100, 30, -5}, {100, 70, -5}));
  apply(now, line(saw, {300, 300, -10}, {310, 300, -10}));
  apply(now, line(tool, {500, 500, -30}, {500, 500, -30}));
  std::vector<std::array<int, 2>> expected;
  for (int row = 0; row < now.grid().rows; ++row)
    for (int column = 0; column < now.grid().columns; ++column) {
      const auto before = intervals(old, column, row);
      const auto after = intervals(now, column, row);
      const auto is_same = [](const HeightInterval& one, const HeightInterval& other) {
        return one.bottom == other.bottom && one.top == other.top;
      };
      if (!std::equal(before.begin(), before.end(), after.begin(), after.end(), is_same))
        expected.push_back({row, column});
    }
  ASSERT_GT(expected.size(), 1000U);
  for (const auto& [one, other] : {std::pair(&old, &std::as_const(now)), std::pair(&std::as_const(now), &old)}) {
    std::vector<std::array<int, 2>> found;
    for_each_change(*one, *other, [&](int row, int column) { found.push_back({row, column}); });
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected);
  }
}

TEST(Stock, AirCutsShareEverything) {
  const RevolvedBody tool = flat(5);
  Stock stock(kPlate, 0.5);
  apply(stock, line(tool, {32, 32, -5}, {250, 32, -5}));
  const Stock copy = stock;
  EXPECT_FALSE(apply(stock, line(tool, {32, 32, -5}, {250, 32, -5})).meets()) << "the same again";
  EXPECT_FALSE(apply(stock, line(tool, {0, 100, 0}, {250, 100, 0})).meets()) << "on the surface";
  EXPECT_TRUE(stock.tiles_changed_since(copy).empty());
}

TEST(Stock, AnswersWhatIsBelowAndWhoCutIt) {
  const RevolvedBody tool = flat(5);
  const RevolvedBody saw = body(solids::disc_body(20, 3));
  Stock stock(kPlate, 0.5);
  EXPECT_EQ(stock.cut_by(100, 100), std::nullopt);
  apply(stock, line(tool, {50, 100, -6}, {150, 100, -6}, {0, 0, 1}, 41));
  apply(stock, line(saw, {100, -30, -14}, {100, 230, -14}, {0, 0, 1}, 42));  // A slot from -14 to -11.
  EXPECT_EQ(stock.cut_by(60, 100), std::optional<CutTag>(41));
  EXPECT_EQ(stock.cut_by(100, 100), std::optional<CutTag>(42));
  const std::vector<HeightInterval> left = stock.intervals_at(100, 100);
  ASSERT_EQ(left.size(), 2U);
  EXPECT_NEAR(left[0].top, -14, 1e-5);
  EXPECT_NEAR(left[1].bottom, -11, 1e-5);
  EXPECT_NEAR(left[1].top, -6, 1e-5);
  EXPECT_NEAR(stock.first_below({100, 100, 10})->top, -6, 1e-5);
  EXPECT_NEAR(stock.first_below({100, 100, -12})->top, -14, 1e-5);
  EXPECT_NEAR(stock.first_below({100, 100, -8})->top, -8, 1e-5);
  EXPECT_FALSE(stock.first_below({100, 100, -19}));
  EXPECT_FALSE(stock.first_below({1000, 100, 10}));
  EXPECT_TRUE(stock.intervals_at(-1, 100).empty());
}

TEST(Stock, AskingSeesTheStockOfItsMoment) {
  const RevolvedBody tool = flat(5);
  const std::vector<Sweep> sweeps = {
      asking(line(tool, {100, 100, -4}, {120, 100, -4})), line(tool, {100, 100, -4}, {120, 100, -4}),
      asking(line(tool, {100, 100, -4}, {120, 100, -4})), asking(line(tool, {120, 100, -4}, {120, 100, 50})),
      asking(line(tool, {100, 100, -4}, {121, 100, -4}))};
  Stock stock(kPlate, 0.5);
  const auto outcomes = stock.apply(sweeps);
  EXPECT_NEAR(outcomes[0].volume, (25 * pi + 200) * 4, 5);
  EXPECT_NEAR(outcomes[0].depth, 4, 1e-5);
  EXPECT_NEAR(outcomes[0].point.z(), -4, 1e-5);
  EXPECT_TRUE(outcomes[1].meets());
  EXPECT_FALSE(outcomes[2].meets()) << "the tool touches what it has cut";
  EXPECT_FALSE(outcomes[3].meets()) << "and moves up along the wall";
  EXPECT_TRUE(outcomes[4].meets());
  EXPECT_GT(outcomes[4].point.x(), 120);
}

/// What finds meets material where what asks does, and nowhere else; and so does a larger body that follows.
TEST(Stock, FindingMeetsWhatAskingMeets) {
  const RevolvedBody holder({{.core = {20, 12, 60, 18}}, {.core = {60, 14, 120, 30}}});
  const RevolvedBody grown({{.core = {20, 12, 60, 18}, .rounding = 1.5}, {.core = {60, 14, 120, 30}, .rounding = 1.5}});
  int met = 0;
  int grown_alone = 0;
  int deep = 0;
  for (const std::uint64_t seed : support::seeds(5)) {
    Random random(seed);
    Stock stock(kPlate, 0.7);
    stock.apply(SomeSweeps().make(seed, 30));
    std::vector<Sweep> asked;
    for (int i = 0; i < (support::kTriesAll ? 25 : 5); ++i) {
      const Vec3 at(random.real(-40, 340), random.real(-40, 240), random.real(-40, 20));
      const Vec3 to = at + Vec3(random.real(-9, 9), random.real(-9, 9), random.real(-4, 4));
      const double degrees = random.real(-120, 120);
      Sweep sweep = line(holder, at, to, tilted(degrees));
      if (!random.one_in(4)) sweep = turn(holder, {at, tilted(degrees)}, {to, tilted(degrees + random.real(-4, 4))});
      asked.push_back(asking(sweep));
      sweep.body = &grown;
      asked.push_back(asking(sweep));
    }
    std::vector<Sweep> found = asked;
    for (std::size_t i = 0; i < found.size(); ++i) {
      found[i].purpose = SweepPurpose::Find;
      found[i].contains_last = i % 2 == 1;
    }
    const auto of_asked = stock.apply(asked);
    const auto of_found = stock.apply(found, on_threads(3));
    for (std::size_t i = 0; i < asked.size(); ++i) {
      ASSERT_EQ(of_found[i].meets(), of_asked[i].meets()) << "seed " << seed << ", sweep " << i;
      EXPECT_LE(of_found[i].depth, of_asked[i].depth) << "seed " << seed << ", sweep " << i;
      met += of_asked[i].meets() ? 1 : 0;
      deep += of_found[i].volume < of_asked[i].volume ? 1 : 0;
      grown_alone += i % 2 == 1 && of_asked[i].meets() && !of_asked[i - 1].meets() ? 1 : 0;
    }
    expect_same(stock.apply(found), of_found);
  }
  if (!support::kTriesAll) return;
  EXPECT_GT(met, 50);
  EXPECT_GT(deep, 20) << "finding is to look at less";
  EXPECT_GT(grown_alone, 0);
}

TEST(Stock, DepthIsAlongTheAxis) {
  const RevolvedBody tool = flat(5, 100);
  Stock stock(box({0, 0, -50}, {100, 100, 0}), 0.5);
  EXPECT_NEAR(apply(stock, line(tool, {20, 20, 5}, {20, 20, -30})).depth, 30, 1e-4);
  const Vec3 axis = tilted(60);
  // Through the whole plate of 50 mm, the longest line of material in the tool is its diameter over the sine.
  EXPECT_NEAR(apply(stock, line(tool, Vec3(50, 60, -25) - 60 * axis, Vec3(50, 60, -25) - 60 * axis, axis)).depth,
              10 / std::sin(pi / 3) * std::cos(pi / 3), 0.05);
}

TEST(Stock, BackwardsIsTheSame) {
  const SomeSweeps source;
  std::vector<Sweep> forward = source.make(5, 40);
  std::erase_if(forward, [](const Sweep& sweep) { return !std::holds_alternative<StraightPath>(sweep.path); });
  for (const Sweep& sweep : forward) {
    Sweep back = sweep;
    StraightPath& path = std::get<StraightPath>(back.path);
    std::swap(path.from.origin, path.to);
    if (path.from.axis.z() < 1) continue;  // Equal but for the last digit.
    Stock one(kPlate, 1);
    Stock other(kPlate, 1);
    apply(one, sweep);
    apply(other, back);
    expect_same(one, other);
    if (HasFatalFailure()) return;
  }
}

TEST(Stock, TurnsBackAsItTurns) {
  const RevolvedBody tools[] = {flat(6, 60), ball(6, 60), body(solids::cone_body(6, 1, 60, 60))};
  const Stock stock(kPlate, 0.5);
  const AxisPlacement from{{100, 100, -6}, tilted(-20)};
  const AxisPlacement to{{104, 103, -8}, tilted(25)};
  for (const RevolvedBody& tool : tools)
    EXPECT_NEAR(removed(stock, {turn(tool, from, to)}) / removed(stock, {turn(tool, to, from)}), 1, 1e-6);
}

/// Where on its axis a body has its origin is nothing to the material.
TEST(Stock, DoesNotDependOnWhereABodyHasItsOrigin) {
  for (const RevolvedBody& tool : {flat(6, 60), ball(6, 60), body(solids::drill_body(6, 118, 60)),
                                   body(solids::bull_body(6, 2, 60)), body(solids::disc_body(6, 3))})
    for (const double up : {-70.0, -7.0, 5.0}) {
      std::vector<solids::BodyPiece> pieces;
      for (solids::BodyPiece piece : tool.pieces()) {
        piece.core.bottom += up;
        piece.core.top += up;
        pieces.push_back(piece);
      }
      const RevolvedBody shifted(pieces);
      for (const Vec3& axis : {Vec3(0, 0, 1), Vec3(0, 0, -1), tilted(30)})
        for (const Vec3& travel : {Vec3(0, 0, 0), Vec3(30, 7, 0), Vec3(0, 0, -6), Vec3(30, 7, -6)}) {
          const Stock stock(kPlate, 1);
          const Vec3 from(100, 100, axis.z() < 0 ? 52 : -4);
          const double expected = removed(stock, {line(tool, from, from + travel, axis)});
          const Vec3 origin = from - up * axis;
          EXPECT_NEAR(removed(stock, {line(shifted, origin, origin + travel, axis)}), expected, 1e-4 * expected + 1e-3)
              << up << ", travel " << travel.transpose() << ", axis " << axis.transpose();
        }
    }
}

/// A height that no float has is rounded so that too little is cut, by a last digit, rather than too much.
TEST(Stock, RoundsHeightsTowardsTheMaterial) {
  const RevolvedBody saw = body(solids::disc_body(6, 3));
  for (const double low : {-9.1, -9.2, -9.3, -9.7}) {
    Stock stock(box({0, 0, -18}, {60, 40, 0}), 1);
    apply(stock, line(saw, {20, 20, low}, {40, 20, low + 4}));
    const std::vector<HeightInterval> first = stock.intervals_at(15.5, 20.5);
    ASSERT_EQ(first.size(), 2U);
    EXPECT_GE(first[0].top, low);
    EXPECT_NEAR(first[0].top, low, 2e-6);
    const std::vector<HeightInterval> last = stock.intervals_at(44.5, 20.5);
    ASSERT_EQ(last.size(), 2U);
    EXPECT_LE(last[1].bottom, low + 4 + 3);
    EXPECT_NEAR(last[1].bottom, low + 4 + 3, 2e-6);
  }
}

TEST(Stock, SplitMovesRemoveTheSame) {
  const RevolvedBody tools[] = {flat(6), ball(6), body(solids::bull_body(6, 2, 60)),
                                body(solids::cone_body(6, 1, 60, 60))};
  for (const RevolvedBody& tool : tools)
    for (const Vec3& axis : {Vec3(0, 0, 1), tilted(30)}) {
      const Vec3 from(40, 50, -3);
      const Vec3 to(200, 120, -12);
      std::vector<Sweep> parts;
      for (int i = 0; i < 5; ++i)
        parts.push_back(line(tool, from + i / 5.0 * (to - from), from + (i + 1) / 5.0 * (to - from), axis));
      const Stock stock(kPlate, 0.5);
      const double whole = removed(stock, {line(tool, from, to, axis)});
      EXPECT_NEAR(removed(stock, parts) / whole, 1, 0.0005);
    }
}

TEST(Stock, ShiftsByPartsOfTheSpacingHardlyMatter) {
  const RevolvedBody tool = ball(6);
  const Stock stock(kPlate, 0.5);
  const double expected = removed(stock, {line(tool, {40, 50, -3}, {200, 120, -12})});
  for (int i = 1; i < 7; ++i) {
    const Vec3 shift(i * 0.071, i * 0.113, 0);
    EXPECT_NEAR(removed(stock, {line(tool, Vec3(40, 50, -3) + shift, Vec3(200, 120, -12) + shift)}) / expected, 1,
                0.001);
  }
}

TEST(Stock, SweepsThatMakeNoSenseDoNothing) {
  const double nan = std::nan("");
  const double infinite = std::numeric_limits<double>::infinity();
  const RevolvedBody tool = flat(5);
  const RevolvedBody ball_tool = ball(5);
  Stock stock(kPlate, 1);
  const Stock copy = stock;
  for (const double bad : {nan, infinite, -infinite, 1e300, 1e7}) {
    for (const RevolvedBody* body : {&tool, &ball_tool}) {
      for (int i = 0; i < 3; ++i) {
        Vec3 to(100, 100, -5);
        to[i] = bad;
        apply(stock, line(*body, {50, 50, -5}, to));
        apply(stock, line(*body, to, {50, 50, -5}, tilted(30)));
        apply(stock, arc(*body, {50, 50, -5}, to, {60, 50, -5}, 90));
        apply(stock, turn(*body, {{50, 50, -5}, tilted(1)}, {to, tilted(9)}));
        Vec3 axis(0, 0, 1);
        axis[i] = bad;
        apply(stock, line(*body, {50, 50, -5}, {60, 50, -5}, axis));
      }
      apply(stock, arc(*body, {50, 50, -5}, {60, 50, -5}, {55, 50, -5}, bad));
    }
  }
  apply(stock, line(tool, {50, 50, -5}, {60, 50, -5}, {0, 0, 0}));
  apply(stock, line(tool, {50, 50, -5}, {60, 50, -5}, {0, 0, 2}));
  apply(stock, {.body = nullptr, .path = StraightPath{{{0, 0, 0}, {0, 0, 1}}, {1, 1, -5}}});
  EXPECT_TRUE(stock.apply({}).empty());
  EXPECT_TRUE(stock.tiles_changed_since(copy).empty());
}

TEST(Stock, ExtremeSweepsEnd) {
  const RevolvedBody tools[] = {flat(5),
                                ball(5),
                                body(solids::bull_body(5, 1, 30)),
                                body(solids::drill_body(5, 90, 30)),
                                body(solids::flat_body(1e-9, 1e-9)),
                                body(solids::ball_body(1e4, 1e5)),
                                RevolvedBody({{.core = {0, 0, 0, 0}}})};
  Stock stock(box({0, 0, -5}, {20, 20, 0}), 1);
  Random random(1);
  const auto any = [&] { return Vec3(random.real(-1, 1), random.real(-1, 1), random.real(-1, 1)); };
  for (const RevolvedBody& tool : tools)
    for (const double size : {0.0, 1e-300, 1e-9, 1.0, 1e5, 9e5}) {
      const Vec3 from = size * any();
      const Vec3 to = size * any();
      apply(stock, asking(line(tool, from, to)));
      apply(stock, asking(line(tool, from, to, tilted(30))));
      apply(stock, asking(line(tool, from, to, tilted(90))));
      apply(stock, asking(arc(tool, from, from, from + Vec3(size, 0, 0), 360)));
      apply(stock, asking(arc(tool, from, to, (from + to) / 2, 180, {0, 1, 0})));
      if (size < 1e5) apply(stock, asking(turn(tool, {from, tilted(1e-12)}, {to, tilted(1)})));
    }
  EXPECT_NEAR(stock.volume(), 2000, 1e-6);
}

}  // namespace
}  // namespace isocnc::stock::cuts
