#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "interpreter/solids/clearance.h"
#include "tests/solids/scenes.h"

namespace isocnc::solids::scenes {

/// Expects of `distance`, which takes what is sufficient, that it bounds a known gap closely, and from below in any
/// case.
template <class Distance>
void expect_bounds(Random& random, double gap, Distance&& distance) {
  const Clearance found = distance(kExact);
  if (gap > kSceneError) {
    ASSERT_LE(found.lower, gap + kSceneError);
    ASSERT_GE(found.upper, gap - kSceneError);
    ASSERT_LE(found.upper - found.lower, 2 * kRounding);
    ASSERT_NEAR((found.on_body - found.on_obstacle).norm(), gap, 1e-5);
  } else if (gap < -kSceneError) {
    ASSERT_LT(found.upper, 0);
    ASSERT_EQ(found.lower, found.upper);
  }
  const double sufficient = random.real(0, 300);
  const Clearance coarse = distance(sufficient);
  ASSERT_LE(coarse.lower, std::max(gap, 0.0) + kSceneError);
  ASSERT_TRUE(coarse.lower >= sufficient || coarse.upper - coarse.lower <= 2 * kRounding);
}

}  // namespace isocnc::solids::scenes
