#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "interpreter/solids/advance.h"
#include "tests/solids/expected_bounds.h"

/// Distances and first contacts in random scenes of which the true gap is known by construction.
namespace isocnc::solids {
namespace {

using scenes::kSceneError;
using scenes::Random;
using scenes::Touch;
using scenes::Vec3;

/// A placement in line with the obstacle now and then, as most tools stand.
Vec3 any_axis(Random& random) {
  if (!random.one_in(3)) return scenes::any_direction(random);
  return Vec3(Vec3::Unit(random.between(0, 2)));
}

template <class Obstacle>
void expect_known_distance(Random& random, const Obstacle& obstacle) {
  const RevolvedBody body = scenes::any_body(random);
  const Touch touch = scenes::any_touch(random, obstacle);
  const double gap = random.one_in(2) ? random.real(-0.1, 0.1) : random.real(0, 200);
  const AxisPlacement at = scenes::placed_at_gap(body, any_axis(random), touch, gap);
  scenes::expect_bounds(random, gap, [&](double sufficient) { return clearance(body, at, obstacle, sufficient); });
}

TEST(ClearanceProperty, BoundsTheKnownDistanceOfBoxes) {
  for (const std::uint64_t seed : support::seeds(10'000)) {
    SCOPED_TRACE(seed);
    Random random(seed);
    expect_known_distance(random, scenes::any_cuboid(random));
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(ClearanceProperty, BoundsTheKnownDistanceOfCylinders) {
  for (const std::uint64_t seed : support::seeds(10'000)) {
    SCOPED_TRACE(seed);
    Random random(seed);
    expect_known_distance(random, scenes::any_cylinder(random));
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(ClearanceProperty, BoundsTheKnownDistanceOfMeshes) {
  Random shapes(7);
  std::vector<Mesh> meshes;
  for (int i = 0; i < 8; ++i) {
    meshes.emplace_back(scenes::box_triangles(scenes::any_cuboid(shapes)));
    meshes.emplace_back(scenes::bumpy_ball(scenes::any_point(shapes, 200), shapes.real(5, 100), 4 + 3 * i, 0.05));
  }
  for (const std::uint64_t seed : support::seeds(5'000)) {
    SCOPED_TRACE(seed);
    Random random(seed);
    expect_known_distance(random, meshes[random.below(meshes.size())]);
    if (testing::Test::HasFatalFailure()) return;
  }
}

/// A motion whose smallest distance is known: the body passes the touched plane at the gap, along a parabola that
/// touches it, in a random direction.
struct Pass {
  AxisPlacement nearest;
  Vec3 along;
  Vec3 away;
  double bend = 0;

  AxisPlacement at(double s) const { return {nearest.origin + s * along + bend * s * s * away, nearest.axis}; }
};

template <class Obstacle>
void expect_known_contact(Random& random, const Obstacle& obstacle) {
  const RevolvedBody body = scenes::any_body(random);
  const Touch touch = scenes::any_touch(random, obstacle);
  const double gap = random.real(-0.1, 0.1);
  Pass pass{.nearest = scenes::placed_at_gap(body, any_axis(random), touch, gap), .away = touch.normal};
  pass.along = touch.normal.cross(scenes::any_direction(random)).normalized();
  pass.bend = random.one_in(2) ? 0 : random.real(0, 0.2);
  const double begin = -random.real(0.1, 20);
  const double end = random.real(0, 20);
  const double bend_speed = 2 * pass.bend * std::max(-begin, end);
  const double speed = std::sqrt(1 + bend_speed * bend_speed);
  const AdvanceOptions options{.contact = 0.01, .max_evaluations = 100'000};
  const AdvanceResult result = first_contact(
      begin, end, [&](double s, double sufficient) { return clearance(body, pass.at(s), obstacle, sufficient); },
      [&](double) { return speed; }, options);
  ASSERT_NE(result.verdict, AdvanceResult::Verdict::Undecided);
  if (gap < options.contact / 2 - kSceneError) {
    ASSERT_EQ(result.verdict, AdvanceResult::Verdict::Contact) << gap;
  }
  if (gap > options.contact + kSceneError) {
    ASSERT_EQ(result.verdict, AdvanceResult::Verdict::Clear) << gap;
  }
  ASSERT_LE(result.proven, gap > 0 && result.verdict == AdvanceResult::Verdict::Clear ? gap + kSceneError : kExact);
  ASSERT_LE(result.evaluations, 2 + speed * (end - begin) / (0.9 * options.contact / 2));
}

/// ISOCNC_SCENES=100000 tries that many scenes.
TEST(AdvanceProperty, FindsEveryContactAndReportsNoneAboveItsLimit) {
  Random shapes(3);
  const Mesh ball(scenes::bumpy_ball(Vec3(10, -20, 30), 50, 12, 0.05));
  const char* const wanted = std::getenv("ISOCNC_SCENES");
  for (const std::uint64_t seed : support::seeds(wanted ? std::strtoull(wanted, nullptr, 10) : 3'000)) {
    SCOPED_TRACE(seed);
    Random random(seed);
    switch (random.between(0, 7)) {
      case 0:
        expect_known_contact(random, ball);
        break;
      case 1:
      case 2:
      case 3:
        expect_known_contact(random, scenes::any_cylinder(random));
        break;
      default:
        expect_known_contact(random, scenes::any_cuboid(random));
    }
    if (testing::Test::HasFatalFailure()) return;
  }
}

}  // namespace
}  // namespace isocnc::solids
