#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <span>
#include <variant>
#include <vector>

#include "interpreter/solids/tool_shapes.h"
#include "interpreter/stock/stock.h"
#include "tests/support/random.h"

/// Blanks, cutters and paths for the tests of removed material.
namespace isocnc::stock::cuts {

using geometry::Vec2;
using geometry::Vec3;
using solids::AxisPlacement;
using solids::RevolvedBody;
using std::numbers::pi;

inline RevolvedBody body(const solids::BodyOrProblem& made) { return std::get<RevolvedBody>(made); }
inline RevolvedBody flat(double radius, double length = 100) { return body(solids::flat_body(radius, length)); }
inline RevolvedBody ball(double radius, double length = 100) { return body(solids::ball_body(radius, length)); }

inline solids::Cuboid box(const Vec3& low, const Vec3& high) { return {low, high}; }
/// 400 x 400 x 100 mm, its upper face at 0, the middle of it at the origin.
inline solids::Cuboid block() { return box({-200, -200, -100}, {200, 200, 0}); }

inline Sweep line(const RevolvedBody& body, const Vec3& from, const Vec3& to, const Vec3& axis = {0, 0, 1},
                  CutTag tag = 1) {
  return {.body = &body, .path = StraightPath{{from, axis}, to}, .tag = tag};
}
inline Sweep arc(const RevolvedBody& body, const Vec3& from, const Vec3& to, const Vec3& center, double degrees,
                 const Vec3& normal = {0, 0, 1}, CutTag tag = 1) {
  return {.body = &body, .path = HelixPath{geometry::helix(from, to, center, normal, degrees)}, .tag = tag};
}
inline Sweep turn(const RevolvedBody& body, const AxisPlacement& from, const AxisPlacement& to, CutTag tag = 1) {
  return {.body = &body, .path = TurningPath{from, to}, .tag = tag};
}
inline Sweep asking(Sweep sweep) {
  sweep.purpose = SweepPurpose::Ask;
  return sweep;
}

inline SweepOutcome apply(Stock& stock, const Sweep& sweep) { return stock.apply(std::span(&sweep, 1)).front(); }

/// What sweeps remove in all, mm^3.
inline double removed(Stock stock, const std::vector<Sweep>& sweeps) {
  const double before = stock.volume();
  stock.apply(sweeps);
  return before - stock.volume();
}

/// The intervals of the dexel in a column and a row of the whole grid.
inline std::vector<HeightInterval> intervals(const Stock& stock, int column, int row) {
  return stock.tile({column / Tile::kSize, row / Tile::kSize}).intervals(row % Tile::kSize, column % Tile::kSize);
}

/// Both stocks have the same material, to the last bit.
inline void expect_same_material(const Stock& one, const Stock& other) {
  ASSERT_EQ(one.grid().columns, other.grid().columns);
  ASSERT_EQ(one.grid().rows, other.grid().rows);
  for (int row = 0; row < one.grid().rows; ++row)
    for (int column = 0; column < one.grid().columns; ++column) {
      const std::vector<HeightInterval> of_one = intervals(one, column, row);
      const std::vector<HeightInterval> of_other = intervals(other, column, row);
      ASSERT_EQ(of_one.size(), of_other.size()) << column << ' ' << row;
      for (std::size_t i = 0; i < of_one.size(); ++i) {
        ASSERT_EQ(of_one[i].bottom, of_other[i].bottom) << column << ' ' << row;
        ASSERT_EQ(of_one[i].top, of_other[i].top) << column << ' ' << row;
      }
    }
}

/// A vector tilted from Z towards X.
inline Vec3 tilted(double degrees) { return {std::sin(degrees * pi / 180), 0, std::cos(degrees * pi / 180)}; }

/// A program of all kinds of sweeps over a plate of 300 x 200 mm.
class SomeSweeps {
 public:
  std::vector<Sweep> make(std::uint64_t seed, int count) const {
    support::Random random(seed);
    std::vector<Sweep> all;
    Vec3 at(150, 100, 0);
    for (int i = 0; i < count; ++i) {
      const RevolvedBody& tool = tools_[random.below(tools_.size())];
      const Vec3 to = Vec3(random.real(-5, 305), random.real(-5, 205), random.real(-20, 3));
      const Vec3 axis = random.one_in(3) ? tilted(random.real(-60, 60)) : Vec3(0, 0, 1);
      const auto tag = static_cast<CutTag>(i);
      Sweep sweep = line(tool, at, to, axis, tag);
      if (random.one_in(4)) sweep = arc(tool, to, to, to + Vec3(random.real(1, 30), 0, 0), 360, {0, 0, 1}, tag);
      if (random.one_in(20)) sweep = turn(tool, {to, axis}, {to, tilted(random.real(-60, 60))}, tag);
      if (random.one_in(4)) sweep = asking(sweep);
      all.push_back(sweep);
      at = to;
    }
    return all;
  }

 private:
  std::vector<RevolvedBody> tools_ = {flat(6, 50), ball(4, 50), body(solids::bull_body(8, 2, 50)),
                                      body(solids::drill_body(5, 118, 50))};
};

inline const solids::Cuboid kPlate = box({0, 0, -18}, {300, 200, 0});

}  // namespace isocnc::stock::cuts
