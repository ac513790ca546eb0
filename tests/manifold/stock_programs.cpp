// Makes random programs, cuts them by the dexels of interpreter/stock, and prints each with what came of it, as a line
// of JSON for compare.mjs: stock_programs FIRST_SEED COUNT

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include "interpreter/solids/tool_shapes.h"
#include "interpreter/stock/stock.h"
#include "tests/support/random.h"

namespace isocnc::stock {
namespace {

using geometry::Vec3;
using nlohmann::json;
using solids::RevolvedBody;
using support::Random;

constexpr double kSpacing = 0.5;
constexpr double kLength = 60;  ///< Of each tool: it reaches above the blank.

struct ToolOfProgram {
  double radius;
  double corner;  ///< 0 for a flat tool, the radius for a ball.
  RevolvedBody body;
};

ToolOfProgram random_tool(Random& random) {
  const double radius = random.real(2, 9);
  const double corner = random.one_in(3) ? 0.0 : random.one_in(2) ? radius : random.real(0.2, 0.8) * radius;
  const solids::BodyOrProblem made = corner == 0        ? solids::flat_body(radius, kLength)
                                     : corner == radius ? solids::ball_body(radius, kLength)
                                                        : solids::bull_body(radius, corner, kLength);
  return {radius, corner, std::get<RevolvedBody>(made)};
}

Vec3 random_axis(Random& random, bool is_tilted) {
  if (!is_tilted) return {0, 0, 1};
  const double tilt = random.real(0.05, 0.9);
  const double turn = random.real(0, 2 * std::numbers::pi);
  return {std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), std::cos(tilt)};
}

json as_json(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

/// Short and long motions, level, slanted and straight down; half of the programs with tilted axes. Every tenth motion
/// or so only asks.
json run(std::uint64_t seed) {
  Random random(seed);
  const solids::Cuboid blank{{0, 0, -20}, {random.real(60, 90), random.real(50, 80), 0}};
  Stock stock(blank, kSpacing);
  std::vector<ToolOfProgram> tools;
  for (int i = 0; i < 3; ++i) tools.push_back(random_tool(random));
  const bool has_tilts = random.one_in(2);
  json moves = json::array();
  const auto place = [&] {
    return Vec3(random.real(-5, blank.maximum.x() + 5), random.real(-5, blank.maximum.y() + 5), random.real(-18, -0.5));
  };
  Vec3 at = place();
  const int count = random.between(5, 60);
  for (int i = 0; i < count; ++i) {
    const ToolOfProgram& tool = tools[random.below(tools.size())];
    const Vec3 axis = random_axis(random, has_tilts && random.one_in(2));
    if (random.one_in(5)) at = place();
    Vec3 to = random.one_in(2) ? place() : at + Vec3(random.real(-3, 3), random.real(-3, 3), 0);
    if (random.one_in(3)) to.z() = at.z();
    if (random.one_in(8)) to.head<2>() = at.head<2>();
    const bool asks = random.one_in(10);
    const Sweep sweep{.body = &tool.body,
                      .path = StraightPath{{at, axis}, to},
                      .tag = static_cast<CutTag>(i),
                      .purpose = asks ? SweepPurpose::Ask : SweepPurpose::Cut};
    const SweepOutcome outcome = stock.apply(std::span(&sweep, 1)).front();
    moves.push_back({{"radius", tool.radius},
                     {"corner", tool.corner},
                     {"length", kLength},
                     {"from", as_json(at)},
                     {"to", as_json(to)},
                     {"axis", as_json(axis)},
                     {"asks", asks},
                     {"volume", outcome.volume}});
    at = to;
  }
  return {{"seed", seed},
          {"spacing", stock.spacing()},
          {"blank", {as_json(blank.minimum), as_json(blank.maximum)}},
          {"moves", moves},
          {"volume", stock.volume()}};
}

}  // namespace
}  // namespace isocnc::stock

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const std::uint64_t first = std::strtoull(argv[1], nullptr, 10);
  const std::uint64_t count = std::strtoull(argv[2], nullptr, 10);
  for (std::uint64_t seed = first; seed < first + count; ++seed) std::cout << isocnc::stock::run(seed) << '\n';
}
