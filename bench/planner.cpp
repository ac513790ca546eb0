// How many moves the planner takes in a second: short lines, arcs, and five axes at once.

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
std::vector<Move> wander(GoOn&& go_on) {
  std::mt19937 random(1);
  std::uniform_real_distribution<> between(-1, 1);
  std::vector<Move> moves;
  geometry::Pose at;
  double heading = 0;
  for (int i = 0; i < kMoves; ++i) {
    Move move;
    move.tag = static_cast<std::uint64_t>(i);
    move.from = move.to = at;
    move.feed = {FeedKind::Speed, 200};
    heading += 0.3 * between(random);
    go_on(move, geometry::Vec3(std::cos(heading), std::sin(heading), 0.1 * between(random)), between(random));
    moves.push_back(move);
    at = move.to;
  }
  return moves;
}

void plan(benchmark::State& state, const Machine& machine, const std::vector<Move>& moves) {
  for (auto _ : state) {
    Planner planner(machine);
    for (const Move& move : moves) {
      planner.push(move);
      while (const Stretch* stretch = planner.next()) benchmark::DoNotOptimize(stretch->duration);
    }
    planner.rest();
    while (const Stretch* stretch = planner.next()) benchmark::DoNotOptimize(stretch->duration);
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) * kMoves);
}

void short_lines(benchmark::State& state) {
  plan(state, three_axis_router(), wander([](Move& move, const geometry::Vec3& step, double) { move.to.tip += step; }));
}

void five_axes(benchmark::State& state) {
  plan(state, head_router(), wander([](Move& move, const geometry::Vec3& step, double random) {
         move.to.tip += step;
         move.to.b = std::clamp(move.to.b + random, -100.0, 100.0);
         move.to.c = std::clamp(move.to.c + step.x(), -300.0, 300.0);
       }));
}

void arcs(benchmark::State& state) {
  plan(state, three_axis_router(), wander([](Move& move, const geometry::Vec3& step, double random) {
         move.is_arc = true;
         move.normal = geometry::Vec3::UnitZ();
         move.sweep_deg = 70 + 60 * random;
         move.center += move.from.tip + 10 * geometry::Vec3(step.x(), step.y(), 0);
         const Eigen::AngleAxisd turn(move.sweep_deg * 3.14159265358979323846 / 180, move.normal);
         move.to.tip = move.center + turn * (move.from.tip - move.center);
       }));
}

BENCHMARK(short_lines)->Unit(benchmark::kMillisecond);
BENCHMARK(five_axes)->Unit(benchmark::kMillisecond);
BENCHMARK(arcs)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace isocnc::motion

BENCHMARK_MAIN();
