#include "interpreter/geometry/cubic.h"

#include <gtest/gtest.h>

namespace isocnc::geometry {
namespace {

void expect_range(const Range& found, double minimum, double maximum) {
  EXPECT_NEAR(found.minimum, minimum, 1e-12);
  EXPECT_NEAR(found.maximum, maximum, 1e-12);
}

TEST(CubicRange, HoldsThePeaksBetweenTheEnds) {
  expect_range(cubic_range({0, -3, 0, 1}, -1.5, 1.5), -2, 2);   // s^3 - 3 s: at 1 and -1.
  expect_range(cubic_range({0, -3, 0, 1}, 0, 0.5), -1.375, 0);  // Both are beyond the ends.
  expect_range(cubic_range({2, -4, 1, 0}, 0, 3), -2, 2);        // (s - 2)^2 - 2.
  expect_range(cubic_range({0, 12, -9, 2}, 0, 3), 0, 9);        // At 1 it is 5, at 2 it is 4.
  expect_range(cubic_range({0, 12, -9, 2}, 0.5, 2.25), 4, 5);
  expect_range(cubic_range({1, 1, 0, 1}, -1, 1), -1, 3);  // It only rises.
}

}  // namespace
}  // namespace isocnc::geometry
