#include "analyzer/translation/coordinate_frames.h"

#include <cmath>
#include <numbers>

namespace isocnc::translation {

using geometry::Vec3;

const ForeignPlane& foreign_plane(int g) {
  static constexpr ForeignPlane kXY{17, 0, 1, 2};
  static constexpr ForeignPlane kZX{18, 2, 0, 1};
  static constexpr ForeignPlane kYZ{19, 1, 2, 0};
  return g == 18 ? kZX : g == 19 ? kYZ : kXY;
}

Vec3 TurnedCoordinates::rotated(const Vec3& point, double by) const {
  const double radians = by * std::numbers::pi / 180;
  const double u = point[plane.u] - center_u;
  const double v = point[plane.v] - center_v;
  Vec3 result = point;
  result[plane.u] = center_u + u * std::cos(radians) - v * std::sin(radians);
  result[plane.v] = center_v + u * std::sin(radians) + v * std::cos(radians);
  return result;
}

std::optional<Vec3> CoordinateFrames::zero(int name) const {
  const auto found = zeros_.find(name);
  return found == zeros_.end() ? std::nullopt : std::optional(found->second);
}

/// A turned coordinate is known only with its neighbor in the plane.
static KnownPlace mixed(KnownPlace place, const std::optional<TurnedCoordinates>& rotation) {
  if (!rotation) return place;
  const auto u = static_cast<std::size_t>(rotation->plane.u);
  const auto v = static_cast<std::size_t>(rotation->plane.v);
  place.known[u] = place.known[v] = place.known[u] && place.known[v];
  return place;
}

KnownPlace CoordinateFrames::to_machine(const KnownPlace& program) const {
  if (!has_zero()) return {};
  KnownPlace machine = mixed(program, rotation);
  machine.at = origin() + (rotation ? rotation->turned(program.at) : program.at);
  return machine;
}

KnownPlace CoordinateFrames::from_machine(const KnownPlace& machine) const {
  if (!has_zero()) return {};
  KnownPlace program = mixed(machine, rotation);
  program.at = machine.at - origin();
  if (rotation) program.at = rotation->turned_back(program.at);
  return program;
}

}  // namespace isocnc::translation
