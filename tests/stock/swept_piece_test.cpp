// What a swept piece says of lines before it computes where it meets them.

#include "interpreter/stock/swept_piece.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace isocnc::stock {
namespace {

using geometry::Vec2;
using geometry::Vec3;

/// Pieces of tools that move along short and long lines, in any direction, also with the axis down.
class RandomSweeps {
 public:
  SweptPiece next() {
    solids::BodyPiece piece;
    const double height = one_in(3) ? 0 : between(0.1, 40);
    const double radius = one_in(3) ? 0 : between(0.1, 10);
    piece.core = {.bottom = between(-5, 5), .bottom_radius = radius};
    piece.core.top = piece.core.bottom + height;
    piece.core.top_radius = one_in(2) ? radius : height > 0 ? between(0, 10) : radius;
    if (one_in(2) || (height == 0 && radius == 0)) piece.rounding = between(0.1, 6);
    const Vec3 axis = one_in(5) ? Vec3(0, 0, one_in(2) ? 1 : -1) : direction();
    const Vec3 travel = one_in(5) ? Vec3(Vec3::Zero()) : Vec3(std::pow(10, between(-2, 1.5)) * direction());
    const Vec3 place(between(-2000, 2000), between(-2000, 2000), (one_in(5) ? 100 : 1) * between(-200, 200));
    return {piece, {place, axis}, travel};
  }
  double between(double low, double high) { return std::uniform_real_distribution<>(low, high)(random_); }
  bool one_in(int chances) { return std::uniform_int_distribution<>(1, chances)(random_) == 1; }

 private:
  Vec3 direction() {
    for (;;) {
      const Vec3 any(between(-1, 1), between(-1, 1), between(-1, 1));
      if (any.norm() > 0.1 && any.norm() < 1) return any.normalized();
    }
  }
  std::mt19937 random_{7};
};

TEST(SweptPiece, MeetsNoLineOutsideItsShadow) {
  RandomSweeps random;
  int met = 0;
  int inside = 0;
  for (int i = 0; i < 2'000; ++i) {
    const SweptPiece piece = random.next();
    const auto& box = piece.bounds();
    for (int k = 0; k < 50; ++k) {
      const double x = random.between(box.min().x(), box.max().x());
      const double y = random.between(box.min().y(), box.max().y());
      const HeightInterval shadow = piece.shadow(y);
      // Up to what Newton's method leaves.
      const bool is_inside = shadow.bottom - 1e-5 <= x && x <= shadow.top + 1e-5;
      inside += is_inside ? 1 : 0;
      if (piece.chord(Vec2(x, y)).is_empty()) continue;
      ++met;
      ASSERT_TRUE(is_inside) << "sweep " << i << " at " << x << ", " << y << ", not in " << shadow.bottom << ".."
                             << shadow.top;
    }
  }
  // It is hardly larger than what casts it.
  EXPECT_GT(met, 0.85 * inside);
}

TEST(SweptPiece, MeetsNothingBelowATopThatIsClear) {
  RandomSweeps random;
  int clear = 0;
  int free = 0;
  for (int i = 0; i < 5'000; ++i) {
    const SweptPiece piece = random.next();
    const auto& box = piece.bounds();
    const double step = random.between(0.05, 1);
    const double first = random.between(box.min().x() - 2, box.max().x());
    const double y = random.between(box.min().y() - 1, box.max().y() + 1);
    std::array<float, 3 * kTogether> tops;
    std::array<float, 3 * kTogether> clearances;
    std::array<HeightInterval, 3 * kTogether> chords;
    for (std::size_t k = 0; k < tops.size(); ++k) {
      chords[k] = piece.chord(Vec2(first + static_cast<double>(k) * step, y));
      // Near the lower side, where what is clear ends, or anywhere.
      const bool is_near = !chords[k].is_empty() && !random.one_in(3);
      tops[k] = static_cast<float>(is_near ? chords[k].bottom + std::pow(10, random.between(-6, 1)) - 0.01
                                           : random.between(box.min().z() - 5, box.max().z() + 5));
    }
    piece.clear(first, step, y, static_cast<int>(tops.size()), tops.data(), clearances.data());
    for (std::size_t k = 0; k < tops.size(); ++k) {
      const bool is_below = !chords[k].is_empty() && tops[k] < chords[k].bottom - 0.005;
      free += is_below ? 1 : 0;
      if (!(clearances[k] > 0)) continue;
      clear += is_below ? 1 : 0;
      if (chords[k].is_empty()) continue;
      ASSERT_LE(tops[k], chords[k].bottom) << "sweep " << i << ", line " << k;
    }
  }
  // Most that are free are known to be.
  EXPECT_GT(clear, 0.8 * free);
}

}  // namespace
}  // namespace isocnc::stock
