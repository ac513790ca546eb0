#include "interpreter/solids/clearance.h"

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
  const Clearance nearest = body_to_surface(body, at, obstacle, sufficient);
  // Apart from the surface, the body is on one side of it as a whole, and so is any point of it.
  if (!(nearest.lower > 0 && obstacle.encloses(placed(body.pieces().front(), at).core.middle()))) return nearest;
  return detail::enclosed(nearest, sufficient, [&] { return body_to_surface(body, at, obstacle, kExact); });
}

}  // namespace isocnc::solids
