#include "interpreter/motion/peak_trimmer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace isocnc::motion {
namespace {

constexpr double kMinDuration = 0.1;

/// The phases from rest through these speeds, mm/s, each with the seconds that it takes to get there; trimmed.
std::vector<Phase> trimmed(const std::vector<std::pair<double, double>>& speeds_and_seconds) {
  PeakTrimmer trimmer(kMinDuration);
  Phase at;
  std::vector<Phase> phases;
  const auto take = [&] {
    while (trimmer.has_next()) phases.push_back(trimmer.next());
  };
  for (const auto& [speed, seconds] : speeds_and_seconds) {
    at.duration = seconds;
    at.acceleration = (speed - at.speed) / seconds;
    trimmer.append(at);
    at = at.after(seconds);
    take();
  }
  trimmer.come_to_rest();
  take();
  EXPECT_NEAR(phases.back().after(phases.back().duration).from, at.from, 1e-9) << "the way is as long as before";
  return phases;
}

const Phase& fastest(const std::vector<Phase>& phases) {
  const auto is_slower = [](const Phase& a, const Phase& b) { return a.speed < b.speed; };
  return *std::max_element(phases.begin(), phases.end(), is_slower);
}

/// The peak is cut below its foot: at w, with w T = 2 mm in the peak + (40^2 - w^2) / 100 of the gentle slopes.
TEST(PeakTrimmer, LowersAPeakNoMoreThanItsDurationNeeds) {
  const std::vector<Phase> phases = trimmed({{40, 0.4}, {60, 0.02}, {40, 0.02}, {0, 0.4}});
  ASSERT_EQ(phases.size(), 3U);
  EXPECT_NEAR(phases[1].speed, std::sqrt(5 * 5 + 1800) - 5, 1e-9);
  EXPECT_NEAR(phases[1].duration, kMinDuration, 1e-9);
}

/// Shoulders of 0.06 s on both sides of the peak last long enough together with what it leaves of itself.
TEST(PeakTrimmer, LowersAPeakNoMoreThanToItsShoulders) {
  const std::vector<Phase> phases = trimmed({{40, 0.4}, {40, 0.06}, {42, 0.002}, {40, 0.002}, {40, 0.06}, {0, 0.4}});
  ASSERT_EQ(phases.size(), 3U);
  EXPECT_NEAR(fastest(phases).speed, 40, 1e-9);
  EXPECT_NEAR(fastest(phases).duration, 0.12 + 2 * 41 * 0.002 / 40, 1e-9);
}

}  // namespace
}  // namespace isocnc::motion
