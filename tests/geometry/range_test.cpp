#include "interpreter/geometry/range.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/random.h"

namespace isocnc::geometry {
namespace {

using std::numbers::pi;

TEST(WaveRange, OfAFullTurnIsTheAmplitude) {
  const Range range = wave_range(3, 4, 0, 2 * pi);
  EXPECT_NEAR(range.least, -5, 1e-12);
  EXPECT_NEAR(range.most, 5, 1e-12);
}

TEST(WaveRange, OfAQuarterEndsWhereItEnds) {
  const Range range = wave_range(1, 0, 0, pi / 2);
  EXPECT_NEAR(range.least, 0, 1e-12);
  EXPECT_NEAR(range.most, 1, 1e-12);
}

TEST(WaveRange, OfNoWaveIsItsSlope) {
  const Range range = wave_range(0, 0, -2, 3);
  EXPECT_NEAR(range.least, -6, 1e-12);
  EXPECT_NEAR(range.most, 0, 1e-12);
}

/// Beside a dense walk along the curve.
TEST(WaveRange, HoldsAllThatIsOnTheWayAndNoMore) {
  support::Random random(7);
  for (int i = 0; i < 2'000; ++i) {
    const auto any = [&] { return random.between(-1'000, 1'000) / 100.0; };
    const double p = any();
    const double q = any();
    const double slope = random.between(0, 2) == 0 ? 0 : any();
    const double end = random.between(0, 1'000) / 1'000.0 * 2 * pi;
    const Range range = wave_range(p, q, slope, end);
    constexpr int kSteps = 4'000;
    double least = p;
    double most = p;
    for (int step = 0; step <= kSteps; ++step) {
      const double t = end * step / kSteps;
      const double value = p * std::cos(t) + q * std::sin(t) + slope * t;
      least = std::min(least, value);
      most = std::max(most, value);
    }
    ASSERT_NEAR(range.least, least, 1e-4) << p << ' ' << q << ' ' << slope << ' ' << end;
    ASSERT_NEAR(range.most, most, 1e-4) << p << ' ' << q << ' ' << slope << ' ' << end;
    ASSERT_LE(range.least, least + 1e-12);
    ASSERT_GE(range.most, most - 1e-12);
  }
}

}  // namespace
}  // namespace isocnc::geometry
