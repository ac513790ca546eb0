#include "bench/corpora/arc.h"

#include <cstdlib>
#include <utility>

namespace isocnc::bench {

/// The radius of the circle on which the spokes end.
static constexpr int kSpoke = 65;

Point random_spoke(Random& random) {
  static constexpr Point kSpokes[] = {{65, 0}, {63, 16}, {60, 25}, {56, 33}, {52, 39}};
  Point spoke = kSpokes[random.between(0, 4)];
  if (random.one_in(2)) std::swap(spoke.x, spoke.y);
  if (random.one_in(2)) spoke.x = -spoke.x;
  if (random.one_in(2)) spoke.y = -spoke.y;
  return spoke;
}

Arc random_arc(Random& random, Point start, int reach) {
  while (true) {
    const int scale = random.between(20, 300);
    const Point center = start - scale * random_spoke(random);
    const Point end = center + scale * random_spoke(random);
    if (end == start || std::abs(end.x) > reach || std::abs(end.y) > reach) continue;
    return {.end = end, .center = center, .radius = scale * kSpoke};
  }
}

}  // namespace isocnc::bench
