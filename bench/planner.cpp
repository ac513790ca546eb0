// How many moves the planner takes in a second: short lines, arcs at two feeds, and five axes at once, without limits
// of jerk and with them.

#include "interpreter/motion/planner.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace isocnc::motion {
namespace {

constexpr int kMoves = 100'000;

/// A path that wanders about in steps of `step` made by `go_on`, which has a heading and a random number to go by.
template <typename GoOn>
std::vector<kinematics::Move> random_walk(double feed, GoOn&& go_on) {
  std::mt19937 random(1);
  std::uniform_real_distribution<> between(-1, 1);
  std::vector<kinematics::Move> moves;
  geometry::Pose at;
  double heading = 0;
  for (int i = 0; i < kMoves; ++i) {
    kinematics::Move move;
    move.tag = static_cast<std::uint64_t>(i);
    move.from = move.to = at;
    move.feed = {kinematics::FeedKind::Speed, feed};
    heading += 0.3 * between(random);
    go_on(move, geometry::Vec3(std::cos(heading), std::sin(heading), 0.1 * between(random)), between(random));
    moves.push_back(move);
    at = move.to;
  }
  return moves;
}

std::vector<kinematics::Move> short_lines() {
  return random_walk(200, [](kinematics::Move& move, const geometry::Vec3& step, double) { move.to.tip += step; });
}

std::vector<kinematics::Move> five_axes() {
  return random_walk(200, [](kinematics::Move& move, const geometry::Vec3& step, double random) {
    move.to.tip += step;
    move.to.b = std::clamp(move.to.b + random, -100.0, 100.0);
    move.to.c = std::clamp(move.to.c + step.x(), -300.0, 300.0);
  });
}

std::vector<kinematics::Move> arcs(double feed) {
  return random_walk(feed, [](kinematics::Move& move, const geometry::Vec3& step, double random) {
    move.is_arc = true;
    move.normal = geometry::Vec3::UnitZ();
    move.sweep_deg = 70 + 60 * random;
    move.center += move.from.tip + 10 * geometry::Vec3(step.x(), step.y(), 0);
    const Eigen::AngleAxisd turn(move.sweep_deg * 3.14159265358979323846 / 180, move.normal);
    move.to.tip = move.center + turn * (move.from.tip - move.center);
  });
}

kinematics::Machine with_jerk(kinematics::Machine machine) {
  for (kinematics::AxisLimits& axis : machine.axes) axis.jerk = 10 * axis.acceleration;
  return machine;
}

void plan(benchmark::State& state, const kinematics::Machine& machine, const std::vector<kinematics::Move>& moves) {
  for (auto _ : state) {
    Planner planner(machine);
    for (const kinematics::Move& move : moves) {
      planner.push(move);
      while (const Stretch* stretch = planner.next()) benchmark::DoNotOptimize(stretch->duration);
    }
    planner.rest();
    while (const Stretch* stretch = planner.next()) benchmark::DoNotOptimize(stretch->duration);
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) * kMoves);
}

constexpr double kHeldFeed = 30;          // An arc of 10 mm then takes 90 mm/s^2,
constexpr double kCentripetalFeed = 200;  // or more than the axes have.

BENCHMARK_CAPTURE(plan, short_lines, kinematics::three_axis_router(), short_lines())->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plan, five_axes, kinematics::head_router(), five_axes())->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plan, arcs, kinematics::three_axis_router(), arcs(kHeldFeed))->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plan, fast_arcs, kinematics::three_axis_router(), arcs(kCentripetalFeed))
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plan, short_lines_with_jerk, with_jerk(kinematics::three_axis_router()), short_lines())
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plan, five_axes_with_jerk, with_jerk(kinematics::head_router()), five_axes())
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plan, arcs_with_jerk, with_jerk(kinematics::three_axis_router()), arcs(kHeldFeed))
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(plan, fast_arcs_with_jerk, with_jerk(kinematics::three_axis_router()), arcs(kCentripetalFeed))
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace isocnc::motion

BENCHMARK_MAIN();
