// What distances of tools and of bodies of a head from fixtures cost, and whole motions past them.

#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <variant>
#include <vector>

#include "interpreter/solids/advance.h"
#include "interpreter/solids/clearance.h"
#include "interpreter/solids/tool_shapes.h"

namespace isocnc::solids {
namespace {

using geometry::Vec3;

RevolvedBody body(const BodyOrProblem& made) { return std::get<RevolvedBody>(made); }

/// Cutter, shank, holder and nose of a router.
std::array<RevolvedBody, 4> bodies() {
  const std::vector<StackRow> shank = {{40, 10, 10}};
  const std::vector<StackRow> holder = {{35, 50, 50}, {42, 50, 63}};
  const std::vector<StackRow> nose = {{120, 150, 150}};
  return {body(bull_body(5, 1, 30)), body(stacked_body(shank, 30)), body(stacked_body(holder, 70)),
          body(stacked_body(nose, 147))};
}

/// Eight rows of three suction cups on a table of 3 x 1.5 m.
std::vector<Cuboid> cups() {
  std::vector<Cuboid> all;
  for (int i = 0; i < 24; ++i) {
    const Vec3 corner(100 + 380 * (i % 8), 100 + 500 * (i / 8), -78);
    all.push_back({corner, corner + Vec3(120, 120, 60)});
  }
  return all;
}

/// Placements within `size` of a corner of the first cup, tilted at random.
std::vector<AxisPlacement> placements(double size, double tilt) {
  std::mt19937 random(1);
  std::uniform_real_distribution<> between(-1, 1);
  std::vector<AxisPlacement> all(1024);
  for (AxisPlacement& at : all) {
    at.origin = Vec3(220, 220, -18) + size * Vec3(between(random), between(random), 1.2 + between(random));
    at.axis = Vec3(tilt * between(random), tilt * between(random), 1).normalized();
  }
  return all;
}

Mesh ball(int steps) {
  const auto point = [&](int i, int j) {
    const double tilt = std::numbers::pi * i / steps;
    const double turn = std::numbers::pi * j / steps;
    return Vec3(Vec3(160, 160, -48) +
                60 * Vec3(std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), std::cos(tilt)));
  };
  std::vector<Triangle> triangles;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < 2 * steps; ++j) {
      triangles.push_back({{point(i, j), point(i + 1, j), point(i, j + 1)}});
      triangles.push_back({{point(i, j + 1), point(i + 1, j), point(i + 1, j + 1)}});
    }
  return Mesh(std::move(triangles));
}

template <class Obstacle>
void distances(benchmark::State& state, const RevolvedBody& of, const Obstacle& obstacle, double size,
               double sufficient) {
  const std::vector<AxisPlacement> all = placements(size, 1);
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(clearance(of, all[i++ % all.size()], obstacle, sufficient));
  state.SetItemsProcessed(state.iterations());
}

/// The same for a solid in the frame of a spindle's nose, as a body of a head is.
template <class Moving, class Obstacle>
void solid_distances(benchmark::State& state, const Moving& of, const Obstacle& obstacle, double size,
                     double sufficient) {
  std::vector<Placement> all;
  for (const AxisPlacement& at : placements(size, 1)) {
    Placement& placement = all.emplace_back(Placement::Identity());
    placement.linear() = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), at.axis).toRotationMatrix();
    placement.translation() = at.origin;
  }
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(clearance(of, all[i++ % all.size()], obstacle, sufficient));
  state.SetItemsProcessed(state.iterations());
}

/// Moves of 2 mm over the whole table at a height, which with `turn` tilt the head as well. All 96 pairs are asked.
void advance_moves(benchmark::State& state, double height, double turn) {
  const auto tools = bodies();
  const auto obstacles = cups();
  std::mt19937 random(1);
  std::uniform_real_distribution<> between(0, 1);
  std::int64_t evaluations = 0;
  for (auto _ : state) {
    const Vec3 from(3000 * between(random), 1400 * between(random), height);
    const double tilt = turn > 0 ? between(random) : 0;
    for (const RevolvedBody& tool : tools) {
      const double speed = 1 + turn / 2 * tool.reach(0);
      for (const Cuboid& cup : obstacles) {
        const auto at = [&](double s) {
          const double angle = tilt + turn / 2 * s;
          return AxisPlacement{from + s * Vec3(1, 0, 0), Vec3(std::sin(angle), 0, std::cos(angle))};
        };
        const AdvanceResult found = first_contact(
            0, 2, [&](double s, double sufficient) { return clearance(tool, at(s), cup, sufficient); },
            [&](double) { return speed; }, {.clearance = 2});
        evaluations += found.evaluations;
        benchmark::DoNotOptimize(found.s);
      }
    }
  }
  state.SetItemsProcessed(state.iterations());
  state.counters["evaluations"] = static_cast<double>(evaluations) / static_cast<double>(state.iterations());
}

const Cuboid kCup = cups().front();
const Cylinder kPin{.at = {{160, 160, -78}, {0, 0, 1}}, .height = 60, .radius = 60};
const Cuboid kHeadBox{{-150, -120, 20}, {150, 120, 420}};
const Cylinder kHeadCylinder{.at = {{0, 0, 20}, {0, 0, 1}}, .height = 400, .radius = 120};
const RevolvedBody kCutter = bodies()[0];
const RevolvedBody kHolder = bodies()[2];

BENCHMARK_CAPTURE(distances, far_box, kCutter, kCup, 1.0, -1000.0);
BENCHMARK_CAPTURE(distances, box_exact_cutter, kCutter, kCup, 50.0, kExact);
BENCHMARK_CAPTURE(distances, box_exact_holder, kHolder, kCup, 50.0, kExact);
BENCHMARK_CAPTURE(distances, box_above_2_mm_holder, kHolder, kCup, 50.0, 2.0);
BENCHMARK_CAPTURE(distances, cylinder_exact_holder, kHolder, kPin, 50.0, kExact);
BENCHMARK_CAPTURE(distances, mesh_1800_exact_holder, kHolder, ball(30), 50.0, kExact);
BENCHMARK_CAPTURE(distances, mesh_80000_exact_holder, kHolder, ball(200), 50.0, kExact);
BENCHMARK_CAPTURE(distances, mesh_80000_above_2_mm_holder, kHolder, ball(200), 50.0, 2.0);
BENCHMARK_CAPTURE(solid_distances, head_box_above_2_mm_box, kHeadBox, kCup, 50.0, 2.0);
BENCHMARK_CAPTURE(solid_distances, head_box_exact_box, kHeadBox, kCup, 50.0, kExact);
BENCHMARK_CAPTURE(solid_distances, head_box_exact_cylinder, kHeadBox, kPin, 50.0, kExact);
BENCHMARK_CAPTURE(solid_distances, head_cylinder_exact_cylinder, kHeadCylinder, kPin, 50.0, kExact);
BENCHMARK_CAPTURE(solid_distances, head_box_exact_mesh_1800, kHeadBox, ball(30), 50.0, kExact);
BENCHMARK_CAPTURE(solid_distances, mesh_1800_exact_box, ball(30), kHeadBox, 50.0, kExact);
BENCHMARK_CAPTURE(solid_distances, mesh_1800_exact_mesh_1800, ball(30), ball(30), 300.0, kExact);
BENCHMARK_CAPTURE(advance_moves, three_axes_96_pairs, -17.0, 0.0);
BENCHMARK_CAPTURE(advance_moves, five_axes_96_pairs, -10.0, 0.02);

}  // namespace
}  // namespace isocnc::solids

BENCHMARK_MAIN();
