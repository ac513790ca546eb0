// What removing material costs: random walks of short moves over a panel, as programs of a router have them.

#include <benchmark/benchmark.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <variant>
#include <vector>

#include "interpreter/solids/tool_shapes.h"
#include "interpreter/stock/stock.h"
#include "tests/support/threads.h"

namespace isocnc::stock {
namespace {

using geometry::Vec3;
using solids::RevolvedBody;

RevolvedBody body(const solids::BodyOrProblem& made) { return std::get<RevolvedBody>(made); }

enum class Kind : std::uint8_t { Level, Ramp, Arc, Tilted, FiveAxes };

/// A walk over a panel of 1000 x 1000 mm that turns by some 10 degrees after each move.
std::vector<Sweep> walk(const RevolvedBody& tool, double length, Kind kind, std::size_t count) {
  std::mt19937 random(1);
  std::normal_distribution<> turn(0, 0.2);
  std::uniform_real_distribution<> between(0, 1);
  std::vector<Sweep> all;
  Vec3 at(500, 500, -3);
  Vec3 axis = kind == Kind::Tilted || kind == Kind::FiveAxes ? Vec3(0.3, 0.2, 0.9).normalized() : Vec3(0, 0, 1);
  double heading = 0;
  for (std::size_t i = 0; i < count; ++i) {
    heading += turn(random);
    Vec3 to = at + length * Vec3(std::cos(heading), std::sin(heading), 0);
    if (to.head<2>().minCoeff() < 10 || to.head<2>().maxCoeff() > 990) {
      to = Vec3(20 + 960 * between(random), 20 + 960 * between(random), -2 - 6 * between(random));
      at = to;
    }
    if (kind == Kind::Ramp) to.z() = std::clamp(at.z() + 0.2 * length * (between(random) - 0.5), -12.0, -1.0);
    Sweep sweep{.body = &tool, .path = StraightPath{{at, axis}, to}, .tag = static_cast<CutTag>(i)};
    if (kind == Kind::Arc && to != at) {
      const Vec3 aside = Vec3(0, 0, 1).cross(to - at);
      const Vec3 center = (at + to) / 2 + 2 * aside;
      const double sweep_deg = 2 * std::atan2(0.5, 2.0) * 180 / std::numbers::pi;
      sweep.path = HelixPath{geometry::helix(at, to, center, {0, 0, 1}, sweep_deg), {0, 0, 1}};
    }
    if (kind == Kind::FiveAxes) {
      const Vec3 next =
          (axis + 0.01 * Vec3(between(random) - 0.5, between(random) - 0.5, between(random) - 0.5)).normalized();
      sweep.path = TurningPath{{at, axis}, {to, next}};
      axis = next;
    }
    all.push_back(sweep);
    at = to;
  }
  return all;
}

void cut(benchmark::State& state, const RevolvedBody& tool, double length, double spacing, Kind kind, int threads,
         std::size_t count) {
  const std::vector<Sweep> sweeps = walk(tool, length, kind, count);
  const Workers workers = support::on_threads(threads);
  constexpr std::size_t kBatch = 65536;
  for (auto _ : state) {
    Stock stock(solids::Cuboid{{0, 0, -18}, {1000, 1000, 0}}, spacing);
    for (std::size_t i = 0; i < sweeps.size(); i += kBatch)
      stock.apply(std::span(sweeps).subspan(i, std::min(kBatch, sweeps.size() - i)), workers);
    benchmark::DoNotOptimize(stock.volume());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(count));
}

const RevolvedBody kFlat = body(solids::flat_body(10, 50));
const RevolvedBody kBall = body(solids::ball_body(10, 50));
const RevolvedBody kBull = body(solids::bull_body(10, 2, 50));
const RevolvedBody kSmallBall = body(solids::ball_body(4, 40));
const RevolvedBody kSmallFlat = body(solids::flat_body(4, 40));

#define MOVES(name, ...) \
  BENCHMARK_CAPTURE(cut, name, __VA_ARGS__)->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond)
MOVES(flat_r10_1mm, kFlat, 1.0, 0.5, Kind::Level, 1, 200000);
MOVES(flat_r10_1mm_2_threads, kFlat, 1.0, 0.5, Kind::Level, 2, 200000)->UseRealTime();
MOVES(flat_r10_50mm, kFlat, 50.0, 0.5, Kind::Level, 1, 50000);
MOVES(flat_r10_1mm_h0_1, kFlat, 1.0, 0.1, Kind::Level, 1, 20000);
MOVES(flat_r10_1mm_arc, kFlat, 1.0, 0.5, Kind::Arc, 1, 200000);
MOVES(flat_r10_1mm_ramp, kFlat, 1.0, 0.5, Kind::Ramp, 1, 20000);
MOVES(ball_r10_1mm, kBall, 1.0, 0.5, Kind::Level, 1, 100000);
MOVES(ball_r4_1mm, kSmallBall, 1.0, 0.5, Kind::Level, 1, 200000);
MOVES(ball_r4_1mm_ramp, kSmallBall, 1.0, 0.5, Kind::Ramp, 1, 50000);
MOVES(bull_r10_1mm, kBull, 1.0, 0.5, Kind::Level, 1, 50000);
MOVES(flat_r4_1mm_tilted, kSmallFlat, 1.0, 0.5, Kind::Tilted, 1, 10000);
MOVES(ball_r4_1mm_tilted, kSmallBall, 1.0, 0.5, Kind::Tilted, 1, 10000);
MOVES(flat_r4_1mm_five_axes, kSmallFlat, 1.0, 0.5, Kind::FiveAxes, 1, 10000);
MOVES(ball_r4_1mm_five_axes, kSmallBall, 1.0, 0.5, Kind::FiveAxes, 1, 10000);

}  // namespace
}  // namespace isocnc::stock

BENCHMARK_MAIN();
