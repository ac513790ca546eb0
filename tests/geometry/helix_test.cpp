#include "interpreter/geometry/helix.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/random.h"

namespace isocnc::geometry {
namespace {

Vec3 point(const Helix& helix, double part) {
  const double angle = part * helix.sweep;
  return helix.center + std::cos(angle) * helix.out + std::sin(angle) * helix.side + part * helix.rise;
}

TEST(Helix, RunsInTheDirectionOfItsSweep) {
  const Vec3 from(10, 0, 0);
  const Vec3 to(0, 10, 4);
  const Helix quarter = helix(from, to, Vec3::Zero(), Vec3::UnitZ(), 90);
  EXPECT_TRUE(point(quarter, 0.5).isApprox(Vec3(10 / std::sqrt(2), 10 / std::sqrt(2), 2)));
  const Helix rest = helix(from, to, Vec3::Zero(), Vec3::UnitZ(), -270);
  EXPECT_TRUE(point(rest, 0.5).isApprox(Vec3(-10 / std::sqrt(2), -10 / std::sqrt(2), 2)));
}

/// Through both ends, wherever the center and however it leans, and no place of it is outside its extents.
TEST(Helix, JoinsItsEndsWithinItsExtents) {
  support::Random random(11);
  const auto any = [&] { return random.between(-1'000, 1'000) / 10.0; };
  for (int i = 0; i < 500; ++i) {
    const Vec3 from(any(), any(), any());
    const Vec3 to(any(), any(), any());
    const Vec3 normal = Vec3(any(), any(), 101).normalized();
    const double sweep_deg = (random.between(0, 1) == 0 ? -1 : 1) * random.between(1, 360);
    const Helix found = helix(from, to, Vec3(any(), any(), any()), normal, sweep_deg);
    ASSERT_LT((point(found, 0) - from).norm(), 1e-9);
    ASSERT_LT((point(found, 1) - to).norm(), 1e-9);
    ASSERT_NEAR(found.out.dot(normal), 0, 1e-9);
    const auto extents = found.extents();
    constexpr int kSteps = 100;
    for (int step = 0; step <= kSteps; ++step)
      for (int axis = 0; axis < 3; ++axis) {
        const double value = point(found, static_cast<double>(step) / kSteps)[axis];
        ASSERT_GE(value, extents[static_cast<std::size_t>(axis)].minimum - 1e-9);
        ASSERT_LE(value, extents[static_cast<std::size_t>(axis)].maximum + 1e-9);
      }
  }
}

}  // namespace
}  // namespace isocnc::geometry
