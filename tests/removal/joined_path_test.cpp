#include "interpreter/removal/joined_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/support/random.h"

namespace isocnc::removal {
namespace {

using geometry::Vec3;
using solids::AxisPlacement;

constexpr JoinedPath::Tolerance kTolerance{.aside = 0.0125, .in_height = 0.001};

TipPath line(const Vec3& from, const Vec3& to, const Vec3& axis = {0, 0, 1}) {
  return {.path = stock::StraightPath{{from, axis}, to}, .reach = 40};
}

TipPath turn(const AxisPlacement& from, const AxisPlacement& to) {
  return {.path = stock::TurningPath{from, to}, .reach = 40};
}

/// Whether one piece stands for two lines, of which the first ends at a point
/// near the middle.
bool joins_at(const Vec3& middle, const Vec3& axis = {0, 0, 1}) {
  JoinedPath path(line({0, 0, 0}, middle, axis));
  return path.add(line(middle, {2, 0, 0}, axis), kTolerance);
}

TEST(JoinedPath, GoesFromTheFirstStartToTheLastEnd) {
  JoinedPath path(line({0, 0, 0}, {1, 0.01, 0}));
  EXPECT_TRUE(path.is_single());
  ASSERT_TRUE(path.add(line({1, 0.01, 0}, {2, 0.01, 0}), kTolerance));
  ASSERT_TRUE(path.add(line({2, 0.01, 0}, {3, 0, 0}), kTolerance));
  EXPECT_FALSE(path.is_single());
  EXPECT_EQ(start_of(path.path()).origin, Vec3(0, 0, 0));
  EXPECT_EQ(end_of(path.path()), Vec3(3, 0, 0));
}

TEST(JoinedPath, StraysAsideByTheToleranceAtMost) {
  EXPECT_TRUE(joins_at({1, 0.0124, 0}));
  EXPECT_FALSE(joins_at({1, 0.0126, 0}));
  EXPECT_FALSE(joins_at({0.3, -0.0126, 0}));
}

TEST(JoinedPath, StraysInHeightByLessWhileTheAxisRests) {
  EXPECT_TRUE(joins_at({1, 0, 0.0009}));
  EXPECT_FALSE(joins_at({1, 0, 0.0011}));
  // A tilted tool that is aside is at another height there.
  EXPECT_TRUE(joins_at({1, 0.0009, 0}, Vec3(0, 0.6, 0.8)));
  EXPECT_FALSE(joins_at({1, 0.0011, 0}, Vec3(0, 0.6, 0.8)));
}

TEST(JoinedPath, CountsWhatAPieceStraysOfItsOwnPath) {
  TipPath corner = line({1, 0.006, 0}, {2, 0, 0});
  for (const double stray : {0.006, 0.007}) {
    corner.stray = stray;
    EXPECT_EQ(JoinedPath(line({0, 0, 0}, {1, 0.006, 0})).add(corner, kTolerance), stray == 0.006) << stray;
  }
  corner.stray = 0.006;
  corner.stray_in_height = 0.002;
  EXPECT_FALSE(JoinedPath(line({0, 0, 0}, {1, 0.006, 0})).add(corner, kTolerance));
}

/// A way that turns back passes places which the straight piece does not.
TEST(JoinedPath, TurningBackIsNotOne) {
  JoinedPath path(line({0, 0, 0}, {2, 0, 0}));
  EXPECT_FALSE(path.add(line({2, 0, 0}, {1, 0, 0}), kTolerance));
}

TEST(JoinedPath, ArcsStayAlone) {
  geometry::Helix helix{.center = {0, 0, 0}, .out = {1, 0, 0}, .side = {0, 1, 0}, .rise = {0, 0, 0}, .sweep = 1e-3};
  helix.cosine = std::cos(helix.sweep);
  helix.sine = std::sin(helix.sweep);
  const TipPath arc{.path = stock::HelixPath{.helix = helix}};
  JoinedPath after_line(line({1, -0.001, 0}, {1, 0, 0}));
  EXPECT_FALSE(after_line.add(arc, kTolerance));
  JoinedPath after_arc(arc);
  EXPECT_FALSE(after_arc.add(line(end_of(arc.path), end_of(arc.path) + Vec3(0, 0.001, 0)), kTolerance));
}

/// The tool may matter higher up on the line than at its end, where the axis turns.
TEST(JoinedPath, ALineAtRestStaysApartFromATurn) {
  JoinedPath path(line({0, 0, -20}, {0, 0, 0}));
  EXPECT_FALSE(path.add(turn({{0, 0, 0}, {0, 0, 1}}, {{0, 0, 0.1}, Vec3(1e-4, 0, 1).normalized()}), kTolerance));
}

TEST(JoinedPath, TheAxisStraysTheMoreTheFartherFromTheTip) {
  const auto joins = [](double reach, double sine) {
    const auto tilted = [](double x) { return Vec3(x, 0, std::sqrt(1 - x * x)); };
    const AxisPlacement begin{{0, 0, 0}, tilted(0)};
    const AxisPlacement middle{{0, 1, 0}, tilted(sine)};
    const AxisPlacement end{{0, 2, 0}, tilted(0)};
    TipPath first = turn(begin, middle);
    first.reach = reach;
    TipPath second = turn(middle, end);
    second.reach = reach;
    return JoinedPath(first).add(second, kTolerance);
  };
  // The end of the reach is beside its way by the reach times the sine.
  EXPECT_TRUE(joins(40, 0.0003));
  EXPECT_FALSE(joins(40, 0.00032));
  EXPECT_TRUE(joins(10, 0.0012));
  EXPECT_FALSE(joins(10, 0.00126));
}

Vec3 any_vector(support::Random& random, double size) {
  return {random.real(-size, size), random.real(-size, size), random.real(-size, size)};
}

/// How a tool stands on the way between two placements.
AxisPlacement between(const AxisPlacement& from, const AxisPlacement& to, double share) {
  return {from.origin + share * (to.origin - from.origin),
          Vec3(from.axis + share * (to.axis - from.axis)).normalized()};
}

/// By how much a point of the tool, at most `reach` from the tip, is farther
/// from its place than on the way between two placements where it is nearest.
/// What is to be least has one valley.
double stray_from(const AxisPlacement& at, const AxisPlacement& from, const AxisPlacement& to, double reach) {
  const auto stray = [&](double share) {
    const AxisPlacement there = between(from, to, share);
    return (at.origin - there.origin).norm() + reach * (at.axis - there.axis).norm();
  };
  double low = 0;
  double high = 1;
  for (int i = 0; i < 60; ++i) {
    const double third = (high - low) / 3;
    if (stray(low + third) < stray(high - third)) {
      high -= third;
    } else {
      low += third;
    }
  }
  return stray((low + high) / 2);
}

/// The most by which a tool on one way strays from another one.
double farthest(const std::vector<AxisPlacement>& way, const std::vector<AxisPlacement>& other, double reach) {
  constexpr int kSamples = 50;
  double most = 0;
  for (std::size_t i = 0; i + 1 < way.size(); ++i)
    for (int k = 0; k <= kSamples; ++k) {
      const AxisPlacement at = between(way[i], way[i + 1], static_cast<double>(k) / kSamples);
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t j = 0; j + 1 < other.size(); ++j)
        least = std::min(least, stray_from(at, other[j], other[j + 1], reach));
      most = std::max(most, least);
    }
  return most;
}

/// Wherever the tool is on the pieces, it is somewhere on the one that stands
/// for them within the tolerance, and the other way round.
TEST(JoinedPath, NoPointOfTheToolStraysByMore) {
  int joined = 0;
  int alone = 0;
  for (const std::uint64_t seed : support::seeds(400)) {
    support::Random random(seed);
    const double reach = random.real(2, 100);
    const double size = random.real(0.0005, 0.008);
    const Vec3 way = any_vector(random, 1);
    const AxisPlacement start{any_vector(random, 100), Vec3(random.real(-1, 1), random.real(-1, 1), 1.0).normalized()};
    const Vec3 turned = any_vector(random, 0.02);
    std::vector<AxisPlacement> nodes{start};
    for (int i = 1; i <= 4; ++i)
      nodes.push_back({start.origin + i * way + any_vector(random, size),
                       Vec3(start.axis + i * turned + any_vector(random, size / reach)).normalized()});
    TipPath first = turn(nodes[0], nodes[1]);
    first.reach = reach;
    JoinedPath path(first);
    std::size_t last = 1;
    for (std::size_t i = 1; i + 1 < nodes.size(); ++i) {
      TipPath next = turn(nodes[i], nodes[i + 1]);
      next.reach = reach;
      if (!path.add(next, kTolerance)) break;
      last = i + 1;
    }
    (last > 1 ? joined : alone) += 1;
    const std::vector<AxisPlacement> pieces(nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(last) + 1);
    const std::vector<AxisPlacement> whole{nodes[0], nodes[last]};
    EXPECT_LE(farthest(pieces, whole, reach), kTolerance.aside) << seed;
    EXPECT_LE(farthest(whole, pieces, reach), kTolerance.aside) << seed;
  }
  if (!support::kTriesAll) return;
  EXPECT_GT(joined, 50);
  EXPECT_GT(alone, 50);
}

}  // namespace
}  // namespace isocnc::removal
