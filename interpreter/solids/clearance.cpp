#include "interpreter/solids/clearance.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "interpreter/solids/convex_clearance.h"
#include "interpreter/solids/hulls.h"

namespace isocnc::solids {

using detail::bounded_by;
using detail::is_usable;
using detail::PieceInPlace;
using detail::placed;
using geometry::Vec3;

namespace {

/// How far a body must be moved to be free of a convex obstacle that it overlaps, and the point of the obstacle that
/// its deepest piece is at. A piece that would come into the obstacle on the way counts as well. `touching` is the
/// result where no piece overlaps it after all, but for rounding.
template <class Shape>
Clearance body_in(const RevolvedBody& body, const AxisPlacement& at, const Shape& shape, const Clearance& touching) {
  std::vector<PieceInPlace> overlapping;
  std::vector<PieceInPlace> others;
  std::vector<Clearance> gaps;
  for (const BodyPiece& piece : body.pieces()) {
    const PieceInPlace in_place = placed(piece, at);
    const Clearance found = detail::gap(in_place, shape, 0);
    (found.upper <= 0 ? overlapping : others).push_back(in_place);
    if (found.upper <= 0) gaps.push_back(found);
  }
  if (gaps.empty()) return touching;
  Overlap out;
  for (bool grows = true; grows;) {
    out = overlap(detail::PieceHull(overlapping), shape, true);
    const Vec3 by = -(out.depth + kApart) * out.direction;
    const auto stays_out = std::partition(others.begin(), others.end(), [&](const PieceInPlace& piece) {
      return detail::gap(detail::rounded(piece.core.moved(by), piece.rounding), shape, 0).upper > 0;
    });
    grows = stays_out != others.end();
    overlapping.insert(overlapping.end(), stays_out, others.end());
    others.erase(stays_out, others.end());
  }
  std::size_t deepest = 0;
  const auto depth_of = [&](std::size_t i) {
    return overlapping[i].core.highest(out.direction) + overlapping[i].rounding;
  };
  for (std::size_t i = 1; i < gaps.size(); ++i)
    if (depth_of(i) > depth_of(deepest)) deepest = i;
  Clearance result = gaps[deepest];
  result.lower = result.upper = -out.depth;
  result.way_out = -out.direction;
  return result;
}

/// All pieces of a body against one convex obstacle. A piece need not be known better than the nearest one so far.
template <class Shape>
Clearance body_to(const RevolvedBody& body, const AxisPlacement& at, const Shape& shape, double sufficient) {
  Clearance nearest;
  for (const BodyPiece& piece : body.pieces()) {
    detail::include(nearest, detail::gap(placed(piece, at), shape, std::min(sufficient, nearest.upper)));
    if (nearest.upper <= 0) return body_in(body, at, shape, nearest);
  }
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
  const double bound = detail::coarse_bound(body, at, obstacle.bounds());
  if (bound >= sufficient || !is_usable(bound)) return bounded_by(bound);
  return body_to(body, at, obstacle, sufficient);
}

Clearance clearance(const RevolvedBody& body, const AxisPlacement& at, const Cylinder& obstacle, double sufficient) {
  const double bound = detail::coarse_bound(body, at, obstacle.bounds());
  if (bound >= sufficient || !is_usable(bound)) return bounded_by(bound);
  return body_to(body, at, obstacle.solid(), sufficient);
}

Clearance clearance(const RevolvedBody& body, const AxisPlacement& at, const Mesh& obstacle, double sufficient) {
  const double bound = detail::coarse_bound(body, at, obstacle.bounds());
  if (bound >= sufficient || !is_usable(bound)) return bounded_by(bound);
  Clearance nearest = body_to_surface(body, at, obstacle, sufficient);
  // Apart from the surface, the body is on one side of it as a whole, and so is any point of it.
  if (nearest.lower > 0 && obstacle.encloses(placed(body.pieces().front(), at).core.middle()))
    nearest = detail::enclosed(nearest, sufficient, [&] { return body_to_surface(body, at, obstacle, kExact); });
  if (obstacle.convex() && nearest.upper <= 0) {
    const Clearance found = body_in(body, at, detail::PlacedConvexMesh(obstacle, Placement::Identity()), nearest);
    nearest.lower = nearest.upper = found.upper;
  } else if (nearest.upper < 0 && obstacle.topology().is_closed()) {
    detail::DeepPoints(obstacle, nearest).take(body, at);
  }
  return nearest;
}

namespace {

/// A lower bound of the distance of a piece's way from a shape; 0 or less where they meet.
template <class Core, class Shape>
double way_bound(const detail::RoundedShape<Core>& piece, const Vec3& way, const Shape& shape, double sufficient) {
  return detail::gap(detail::rounded(detail::SweptHull(piece.core, way), piece.rounding), shape, sufficient).lower;
}

template <class Core>
double way_bound(const detail::RoundedShape<Core>& piece, const Vec3& way, const Mesh& mesh, double sufficient) {
  Clearance nearest;
  const auto swept = detail::rounded(detail::SweptHull(piece.core, way), piece.rounding);
  detail::MeshSearch(mesh, swept, sufficient).until_touch(nearest);
  return nearest.lower;
}

}  // namespace

template <Solid Obstacle>
double way_clearance(const RevolvedBody& body, const AxisPlacement& from, const Vec3& way, const Obstacle& obstacle,
                     double sufficient) {
  double lowest = kExact;
  for (const BodyPiece& piece : body.pieces()) {
    const double enough = std::min(sufficient, lowest);
    if constexpr (std::same_as<Obstacle, Cylinder>)
      lowest = std::min(lowest, way_bound(placed(piece, from), way, obstacle.solid(), enough));
    else
      lowest = std::min(lowest, way_bound(placed(piece, from), way, obstacle, enough));
    if (!(lowest > 0)) break;
  }
  return lowest;
}

template double way_clearance(const RevolvedBody&, const AxisPlacement&, const Vec3&, const Cuboid&, double);
template double way_clearance(const RevolvedBody&, const AxisPlacement&, const Vec3&, const Cylinder&, double);
template double way_clearance(const RevolvedBody&, const AxisPlacement&, const Vec3&, const Mesh&, double);

}  // namespace isocnc::solids
