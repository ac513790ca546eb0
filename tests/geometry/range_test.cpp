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
  EXPECT_NEAR(range.minimum, -5, 1e-12);
  EXPECT_NEAR(range.maximum, 5, 1e-12);
}

TEST(WaveRange, OfAQuarterEndsWhereItEnds) {
  const Range range = wave_range(1, 0, 0, pi / 2);
  EXPECT_NEAR(range.minimum, 0, 1e-12);
  EXPECT_NEAR(range.maximum, 1, 1e-12);
}

TEST(WaveRange, OfNoWaveIsItsSlope) {
  const Range range = wave_range(0, 0, -2, 3);
  EXPECT_NEAR(range.minimum, -6, 1e-12);
  EXPECT_NEAR(range.maximum, 0, 1e-12);
}

/// Beside a dense walk along the curve.
TEST(WaveRange, HoldsThePathAndNoMore) {
  support::Random random(7);
  for (int i = 0; i < 2'000; ++i) {
    const auto any = [&] { return random.between(-1'000, 1'000) / 100.0; };
    const double p = any();
    const double q = any();
    const double slope = random.between(0, 2) == 0 ? 0 : any();
    const double end = random.between(0, 1'000) / 1'000.0 * 2 * pi;
    const Range range = wave_range(p, q, slope, end);
    constexpr int kSteps = 4'000;
    double minimum = p;
    double maximum = p;
    for (int step = 0; step <= kSteps; ++step) {
      const double t = end * step / kSteps;
      const double value = p * std::cos(t) + q * std::sin(t) + slope * t;
      minimum = std::min(minimum, value);
      maximum = std::max(maximum, value);
    }
    ASSERT_NEAR(range.minimum, minimum, 1e-4) << p << ' ' << q << ' ' << slope << ' ' << end;
    ASSERT_NEAR(range.maximum, maximum, 1e-4) << p << ' ' << q << ' ' << slope << ' ' << end;
    ASSERT_LE(range.minimum, minimum + 1e-12);
    ASSERT_GE(range.maximum, maximum - 1e-12);
  }
}

}  // namespace
}  // namespace isocnc::geometry
