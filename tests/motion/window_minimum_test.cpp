#include "interpreter/motion/window_minimum.h"

#include <gtest/gtest.h>

namespace isocnc::motion {
namespace {

/// A window that looks back over many pieces, each with limits of its own.
WindowMinimum after_pieces(double fall) {
  WindowMinimum minimum(0.1, 100);
  for (int i = 0; i < 1000; ++i) minimum.append(1, {1e4, 100.0 + i % 7, fall * (1 + i % 5)});
  return minimum;
}

TEST(WindowMinimum, CountsTheMemoryThatItHolds) {
  WindowMinimum minimum = after_pieces(0);
  minimum.come_to_rest();
  const std::size_t full = minimum.memory();
  std::size_t cells = 0;
  while (minimum.next()) ++cells;
  EXPECT_GE(full, minimum.memory() + cells * sizeof(Cell));
  EXPECT_LT(full, 1'000'000U);
  EXPECT_LT(minimum.memory(), 1000U);
}

TEST(WindowMinimum, HoldsMoreWhereAccelerationsFall) {
  EXPECT_GT(after_pieces(1e-6).memory(), after_pieces(0).memory());
}

}  // namespace
}  // namespace isocnc::motion
