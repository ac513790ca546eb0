#include "interpreter/solids/clearance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "interpreter/solids/convex_clearance.h"

namespace isocnc::solids {

using detail::bounded_by;
using detail::is_usable;
using geometry::Vec3;

namespace {

/// A lower bound from the sphere around the body and the box around the obstacle. NaN gives minus infinity.
double coarse_bound(const RevolvedBody& body, const AxisPlacement& at, const BoundingBox& extent) {
  const Vec3 center = at.at(body.middle());
  const double bound = detail::sphere_bound(center, body.sphere_radius(), extent);
  return center.allFinite() && at.axis.allFinite() ? bound : -detail::kUnbounded;
}

using PieceInPlace = detail::RoundedShape<PlacedFrustum>;

PieceInPlace placed(const BodyPiece& piece, const AxisPlacement& at) {
  return {PlacedFrustum(piece.core, at), piece.rounding};
}

/// All pieces of a body against one convex obstacle. A piece need not be known better than the nearest one so far.
template <class Shape>
Clearance body_to(const RevolvedBody& body, const AxisPlacement& at, const Shape& shape, double sufficient) {
  Clearance nearest;
  for (const BodyPiece& piece : body.pieces())
    detail::include(nearest, detail::between(placed(piece, at), shape, std::min(sufficient, nearest.upper)));
  return nearest;
}

Clearance body_to_surface(const RevolvedBody& body, const AxisPlacement& at, const Mesh& mesh, double sufficient) {
  Clearance nearest;
  for (const BodyPiece& piece : body.pieces()) {
    const PieceInPlace in_place = placed(piece, at);
    detail::MeshSearch(mesh, in_place, sufficient).run(nearest);
  }
  return nearest;
}

/// The deepest of some points of a body in a closed mesh: to be free, the body has to move by their distance from the
/// surface. A triangle is left by a body sideways, and shows no larger depth than about the body's radius.
class DeepPoints {
 public:
  DeepPoints(const Mesh& mesh, Clearance& deepest) : mesh_(mesh), deepest_(deepest) {}

  /// Points on the axis and on the surface: at the lower end of each piece, and in the middle of what is in the mesh.
  void take(const RevolvedBody& body, const AxisPlacement& at) {
    constexpr int kLines = 8;
    const Vec3 side = at.axis.unitOrthogonal();
    const Vec3 other = at.axis.cross(side);
    for (const BodyPiece& piece : body.pieces()) {
      const Frustum& core = piece.core;
      take_line(at.at(core.bottom), at.at(core.top), piece.rounding);
      if (!(std::max(core.bottom_radius, core.top_radius) > 0)) continue;
      for (int i = 0; i < kLines; ++i) {
        const double angle = 2 * std::numbers::pi * i / kLines;
        const Vec3 outwards = std::cos(angle) * side + std::sin(angle) * other;
        take_line(at.at(core.bottom) + core.bottom_radius * outwards, at.at(core.top) + core.top_radius * outwards,
                  piece.rounding);
      }
    }
  }

 private:
  void take_line(const Vec3& low, const Vec3& high, double rounding) {
    take_point(low, rounding);
    // What of the line is in the box around the mesh.
    double from = 0;
    double to = 1;
    const Vec3 along = high - low;
    for (int i = 0; i < 3; ++i) {
      const double first = (mesh_.bounds().min()[i] - low[i]) / along[i];
      const double last = (mesh_.bounds().max()[i] - low[i]) / along[i];
      if (std::isnan(first) || std::isnan(last)) continue;
      from = std::max(from, std::min(first, last));
      to = std::min(to, std::max(first, last));
    }
    if (from < to) take_point(low + (from + to) / 2 * along, rounding);
  }

  void take_point(const Vec3& point, double rounding) {
    const BoundingBox& box = mesh_.bounds();
    const double most = std::min((point - box.min()).minCoeff(), (box.max() - point).minCoeff());
    if (!(most > 0 && most + rounding > deepest_.depth()) || !mesh_.encloses(point)) return;
    Clearance found;
    const auto place = detail::rounded(PlacedFrustum({0, 0, 0, 0}, {point, Vec3::UnitZ()}));
    detail::MeshSearch(mesh_, place, kExact).run(found);
    const double depth = found.upper + rounding;
    if (!(depth > deepest_.depth())) return;
    deepest_ = {.lower = -depth, .upper = -depth, .on_body = point, .on_obstacle = found.on_obstacle};
  }

  const Mesh& mesh_;
  Clearance& deepest_;
};

}  // namespace

Clearance clearance(const RevolvedBody& body, const AxisPlacement& at, const Cuboid& obstacle, double sufficient) {
  const double bound = coarse_bound(body, at, obstacle.bounds());
  if (bound >= sufficient || !is_usable(bound)) return bounded_by(bound);
  return body_to(body, at, obstacle, sufficient);
}

Clearance clearance(const RevolvedBody& body, const AxisPlacement& at, const Cylinder& obstacle, double sufficient) {
  const double bound = coarse_bound(body, at, obstacle.bounds());
  if (bound >= sufficient || !is_usable(bound)) return bounded_by(bound);
  return body_to(body, at, obstacle.solid(), sufficient);
}

Clearance clearance(const RevolvedBody& body, const AxisPlacement& at, const Mesh& obstacle, double sufficient) {
  const double bound = coarse_bound(body, at, obstacle.bounds());
  if (bound >= sufficient || !is_usable(bound)) return bounded_by(bound);
  Clearance nearest = body_to_surface(body, at, obstacle, sufficient);
  // Apart from the surface, the body is on one side of it as a whole, and so is any point of it.
  if (nearest.lower > 0 && obstacle.encloses(placed(body.pieces().front(), at).core.middle()))
    nearest = detail::enclosed(nearest, sufficient, [&] { return body_to_surface(body, at, obstacle, kExact); });
  if (nearest.upper < 0 && obstacle.topology().is_closed()) DeepPoints(obstacle, nearest).take(body, at);
  return nearest;
}

}  // namespace isocnc::solids
