#include "interpreter/execution/machine_move.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "interpreter/execution/plane.h"
#include "interpreter/geometry/helix.h"

namespace isocnc::execution {

using geometry::Vec3;

/// Length of a helix whose rise is oblique to the plane of its circle; Simpson's rule on the speed, which is smooth.
static double tilted_helix_length(double radius, double sweep, const Vec3& u, const Vec3& v, const Vec3& rise) {
  const auto speed = [&](double t) {
    const double angle = sweep * t;
    return (radius * sweep * (-std::sin(angle) * u + std::cos(angle) * v) + rise).norm();
  };
  constexpr int kPanels = 256;
  double sum = speed(0) + speed(1);
  for (int i = 1; i < kPanels; ++i) sum += (i % 2 == 1 ? 4 : 2) * speed(static_cast<double>(i) / kPanels);
  return sum / (3 * kPanels);
}

static void compensate(MachineMove& move, const State& state) {
  if (!state.is_compensated()) return;
  const int normal = plane_in_force(state).normal;
  const auto axis = [&](int i) { return state.direction_to_machine(Vec3::Unit((normal + i) % 3)); };
  const auto are_orthogonal = [&](int i, int j) {
    return std::abs(axis(i).dot(axis(j))) < geometry::kOrthogonalCosine;
  };
  move.normal = axis(1).cross(axis(2)).normalized();
  move.compensation = {.side = state.compensation() == dialect::GRole::CompensationLeft ? 1 : -1,
                       .reduces = state.reduces_profile(),
                       .plane_is_sound = are_orthogonal(0, 1) && are_orthogonal(0, 2) && are_orthogonal(1, 2)};
}

static double helix_length(const MachineMove& arc, const Vec3& rise, bool leans) {
  const double sweep = std::abs(arc.sweep_deg) * std::numbers::pi / 180;
  const double height = rise.norm();
  if (!leans) return height == 0 ? arc.radius * sweep : std::hypot(arc.radius * sweep, height);
  const Vec3 start = (arc.from.tip - arc.center).normalized();
  const Vec3 side = arc.normal.cross(start) * (arc.sweep_deg < 0 ? -1 : 1);
  return tilted_helix_length(arc.radius, sweep, start, side, rise);
}

static void add_arc(MachineMove& result, const ProgrammedMove& move, const State& state) {
  const auto axis = [&](int i) { return state.direction_to_machine(Vec3::Unit((move.normal_axis + i) % 3)); };
  const Vec3 along = axis(0);
  result.center = state.to_machine(move.center);
  result.normal = state.face_mounted ? axis(1).cross(axis(2)).normalized() : along;
  result.radius = move.radius;
  result.sweep_deg = move.sweep_deg;
  const Vec3 rise = (move.to.tip[move.normal_axis] - move.from.tip[move.normal_axis]) * along;
  const double height = rise.norm();
  const bool leans = state.face_mounted && height > 0 && rise.cross(result.normal).norm() > 1e-9 * height;
  result.length = helix_length(result, rise, leans);
}

MachineMove in_machine(const ProgrammedMove& move, const State& state) {
  MachineMove result;
  result.kind = move.kind;
  result.from = {state.to_machine(move.from.tip), move.from.b, move.from.c};
  result.to = {state.to_machine(move.to.tip), move.to.b, move.to.c};
  result.length = (result.to.tip - result.from.tip).norm();
  result.feed = move.feed;
  result.inverse_time = move.inverse_time;
  result.five_axis = state.five_axis();
  result.placed = move.placed;
  compensate(result, state);
  if (move.kind == MoveKind::Arc) add_arc(result, move, state);
  return result;
}

std::array<geometry::Range, kAxisCount> extents(const MachineMove& move) {
  std::array<geometry::Range, kAxisCount> all;
  const auto between = [](double a, double b) { return geometry::Range{std::min(a, b), std::max(a, b)}; };
  for (int axis = 0; axis < 3; ++axis)
    all[static_cast<std::size_t>(axis)] = between(move.from.tip[axis], move.to.tip[axis]);
  all[3] = between(move.from.b, move.to.b);
  all[4] = between(move.from.c, move.to.c);
  if (move.kind == MoveKind::Arc && move.sweep_deg != 0) {
    const auto arc = geometry::helix(move.from.tip, move.to.tip, move.center, move.normal, move.sweep_deg).extents();
    std::copy(arc.begin(), arc.end(), all.begin());
  }
  return all;
}

}  // namespace isocnc::execution
