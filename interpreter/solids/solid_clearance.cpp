#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "interpreter/solids/clearance.h"
#include "interpreter/solids/convex_clearance.h"
#include "interpreter/solids/hulls.h"

// Distances between two of the solids that obstacles are made of.

namespace isocnc::solids {

using detail::bounded_by;
using detail::is_usable;
using geometry::Vec3;

namespace {

/// A sphere around a solid, in its frame.
struct Sphere {
  Vec3 center;
  double radius;
};

Sphere sphere_around(const BoundingBox& box) { return {box.center(), box.sizes().norm() / 2}; }
Sphere sphere_around(const Cuboid& box) { return sphere_around(box.bounds()); }
Sphere sphere_around(const Mesh& mesh) { return sphere_around(mesh.bounds()); }
Sphere sphere_around(const Cylinder& cylinder) {
  return {cylinder.at.at(cylinder.height / 2), std::hypot(cylinder.height / 2, cylinder.radius)};
}

/// A lower bound from the sphere around the moving solid and the box around the obstacle. A placement that is not
/// finite gives minus infinity.
template <class Moving, class Obstacle>
double coarse_bound(const Moving& moving, const Placement& at, const Obstacle& obstacle) {
  const Sphere sphere = sphere_around(moving);
  const double bound = detail::sphere_bound(at * sphere.center, sphere.radius, obstacle.bounds());
  return at.affine().allFinite() ? bound : -detail::kUnbounded;
}

const Cuboid& at_rest(const Cuboid& box) { return box; }
PlacedFrustum at_rest(const Cylinder& cylinder) { return cylinder.solid(); }

/// The mesh's frame is that of the result.
template <class Convex>
Clearance convex_to_mesh(const detail::RoundedShape<Convex>& body, const Mesh& mesh, double sufficient) {
  const auto to_surface = [&](double enough) {
    Clearance nearest;
    detail::MeshSearch(mesh, body, enough).run(nearest);
    return nearest;
  };
  Clearance nearest = to_surface(sufficient);
  if (nearest.upper <= 0 && mesh.convex()) {
    const detail::PlacedConvexMesh solid(mesh, Placement::Identity());
    nearest.lower = nearest.upper = -(overlap(body.core, solid).depth + body.rounding);
  }
  if (!(nearest.lower > 0 && mesh.encloses(body.core.middle()))) return nearest;
  return detail::enclosed(nearest, sufficient, [&] { return to_surface(kExact); });
}

/// The walk through the trees of two meshes.
class MeshPairSearch {
 public:
  MeshPairSearch(const Mesh& moving, const Placement& at, const Mesh& obstacle, double sufficient)
      : moving_(moving), at_(at), sizes_(at.linear().cwiseAbs()), obstacle_(obstacle), sufficient_(sufficient) {}

  /// What both surfaces are to each other.
  Clearance run() {
    Clearance nearest;
    depth_ = 0;
    push(paired(0, 0));
    while (depth_ > 0) {
      const QueuedPair pair = open_[--depth_];
      if (pair.bound >= limit(nearest)) {
        nearest.lower = std::min(nearest.lower, pair.bound);
        continue;
      }
      const MeshNode& moving = moving_.nodes()[pair.moving];
      const MeshNode& obstacle = obstacle_.nodes()[pair.obstacle];
      if (moving.count > 0 && obstacle.count > 0)
        compare(moving, obstacle, nearest);
      else
        push_children(pair);
    }
    return nearest;
  }

 private:
  struct QueuedPair {
    std::uint32_t moving;
    std::uint32_t obstacle;
    double bound;
  };

  double limit(const Clearance& nearest) const { return std::min(sufficient_, nearest.upper); }

  QueuedPair paired(std::uint32_t moving, std::uint32_t obstacle) const {
    return {moving, obstacle, bound(moving_.nodes()[moving].box, obstacle_.nodes()[obstacle].box)};
  }

  /// The larger of the bounds that the boxes have in the frame of either mesh, where the other box has a box around it.
  double bound(const BoundingBox& moving, const BoundingBox& obstacle) const {
    const Vec3 moving_half = moving.sizes() / 2;
    const Vec3 obstacle_half = obstacle.sizes() / 2;
    const Vec3 between = at_ * moving.center() - obstacle.center();
    const Vec3 here = between.cwiseAbs() - obstacle_half - sizes_ * moving_half;
    const Vec3 there =
        (at_.linear().transpose() * between).cwiseAbs() - moving_half - sizes_.transpose() * obstacle_half;
    const double widest = std::max(here.maxCoeff(), there.maxCoeff());
    if (!(widest > 0)) return widest - kRounding;
    return std::sqrt(std::max(here.cwiseMax(0).squaredNorm(), there.cwiseMax(0).squaredNorm())) - kRounding;
  }

  /// Most pairs are seen to be further apart than the nearest ones so far along the direction in which these are apart.
  void compare(const MeshNode& moving, const MeshNode& obstacle, Clearance& nearest) const {
    const Vec3 apart = nearest.on_obstacle - nearest.on_body;
    const Vec3 n = nearest.upper > 0 ? Vec3(apart.normalized()) : Vec3(Vec3::Zero());
    for (const Triangle& triangle : moving_.triangles().subspan(moving.first, moving.count)) {
      const auto placed = detail::rounded(triangle.placed(at_));
      const BoundingBox extent = placed.core.bounds();
      const double highest = placed.core.highest(n) + kRounding;
      for (const Triangle& other : obstacle_.triangles().subspan(obstacle.first, obstacle.count)) {
        const double needed = limit(nearest);
        double bound = detail::box_bound(extent, other.bounds());
        if (bound < needed && needed > 0) bound = std::max(bound, other.lowest(n) - highest);
        detail::include(nearest, bound >= needed ? bounded_by(bound) : detail::between(placed, other, needed));
      }
    }
  }

  /// Divides the larger box of both. The nearer half comes out first.
  void push_children(const QueuedPair& pair) {
    const MeshNode& moving = moving_.nodes()[pair.moving];
    const MeshNode& obstacle = obstacle_.nodes()[pair.obstacle];
    const bool divides_moving = obstacle.count > 0 || (moving.count == 0 && moving.box.sizes().squaredNorm() >
                                                                                obstacle.box.sizes().squaredNorm());
    const QueuedPair left = divides_moving ? paired(moving.first, pair.obstacle) : paired(pair.moving, obstacle.first);
    const QueuedPair right =
        divides_moving ? paired(moving.first + 1, pair.obstacle) : paired(pair.moving, obstacle.first + 1);
    push(left.bound <= right.bound ? right : left);
    push(left.bound <= right.bound ? left : right);
  }

  void push(const QueuedPair& pair) { open_[depth_++] = pair; }

  const Mesh& moving_;
  const Placement& at_;
  geometry::Mat3 sizes_;  ///< Takes half the size of a box to half that of the box around it in the other frame.
  const Mesh& obstacle_;
  double sufficient_;
  std::array<QueuedPair, 128> open_;  ///< Each tree is at most 31 deep.
  std::size_t depth_ = 0;
};

/// Whether a closed mesh encloses one of the other's surfaces, where the surfaces are apart.
bool encloses_any(const Mesh& mesh, const Mesh& other, const Placement& of_other) {
  if (!mesh.topology().is_closed()) return false;
  const auto points = other.surface_points();
  return std::any_of(points.begin(), points.end(), [&](const Vec3& point) { return mesh.encloses(of_other * point); });
}

/// Whether both are convex, with so few edges that each may be tried with each.
bool have_few_edges(const ConvexSolid* moving, const ConvexSolid* obstacle) {
  constexpr std::size_t kMaxPairs = 4096;
  return moving && obstacle && moving->edges.size() * obstacle->edges.size() <= kMaxPairs;
}

template <class Moving, class Obstacle>
Clearance exact(const Moving& moving, const Placement& at, const Obstacle& obstacle, double sufficient) {
  return detail::between(detail::rounded(moving.placed(at)), at_rest(obstacle), sufficient);
}

template <class Moving>
Clearance exact(const Moving& moving, const Placement& at, const Mesh& obstacle, double sufficient) {
  return convex_to_mesh(detail::rounded(moving.placed(at)), obstacle, sufficient);
}

/// With the roles exchanged, in the frame of the moving mesh.
template <class Obstacle>
Clearance exact(const Mesh& moving, const Placement& at, const Obstacle& obstacle, double sufficient) {
  Clearance result = convex_to_mesh(detail::rounded(obstacle.placed(at.inverse())), moving, sufficient);
  std::swap(result.on_body, result.on_obstacle);
  result.on_body = at * result.on_body;
  result.on_obstacle = at * result.on_obstacle;
  return result;
}

Clearance exact(const Mesh& moving, const Placement& at, const Mesh& obstacle, double sufficient) {
  Clearance nearest = MeshPairSearch(moving, at, obstacle, sufficient).run();
  if (nearest.upper < 0 && have_few_edges(moving.convex(), obstacle.convex())) {
    const detail::PlacedConvexMesh solid(obstacle, Placement::Identity());
    nearest.lower = nearest.upper = -overlap(detail::PlacedConvexMesh(moving, at), solid).depth;
  }
  if (!(nearest.lower > 0)) return nearest;
  if (!encloses_any(obstacle, moving, at) && !encloses_any(moving, obstacle, at.inverse())) return nearest;
  return detail::enclosed(nearest, sufficient, [&] { return MeshPairSearch(moving, at, obstacle, kExact).run(); });
}

}  // namespace

template <Solid Moving, Solid Obstacle>
Clearance clearance(const Moving& moving, const Placement& at, const Obstacle& obstacle, double sufficient) {
  const double bound = coarse_bound(moving, at, obstacle);
  if (bound >= sufficient || !is_usable(bound)) return bounded_by(bound);
  return exact(moving, at, obstacle, sufficient);
}

template Clearance clearance(const Cuboid&, const Placement&, const Cuboid&, double);
template Clearance clearance(const Cuboid&, const Placement&, const Cylinder&, double);
template Clearance clearance(const Cuboid&, const Placement&, const Mesh&, double);
template Clearance clearance(const Cylinder&, const Placement&, const Cuboid&, double);
template Clearance clearance(const Cylinder&, const Placement&, const Cylinder&, double);
template Clearance clearance(const Cylinder&, const Placement&, const Mesh&, double);
template Clearance clearance(const Mesh&, const Placement&, const Cuboid&, double);
template Clearance clearance(const Mesh&, const Placement&, const Cylinder&, double);
template Clearance clearance(const Mesh&, const Placement&, const Mesh&, double);

}  // namespace isocnc::solids
