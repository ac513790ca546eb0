#include "interpreter/solids/clearance.h"

#include <array>
#include <cmath>
#include <utility>

#include "interpreter/solids/separation.h"

namespace isocnc::solids {

using geometry::Vec3;

namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// Takes the nearer one. Each part of a union bounds the whole by its own distance.
void include(Clearance& whole, const Clearance& part) {
  whole.lower = std::min(whole.lower, part.lower);
  if (part.upper < whole.upper) {
    whole.upper = part.upper;
    whole.on_body = part.on_body;
    whole.on_obstacle = part.on_obstacle;
  }
}

/// A lower bound from the spheres and boxes around both. Written so that NaN gives minus infinity.
double coarse_bound(const RevolvedBody& body, const AxisPlacement& at, const BoundingBox& extent) {
  const Vec3 center = at.at(body.middle());
  const Vec3 outside = (extent.min() - center).cwiseMax(center - extent.max()).cwiseMax(Vec3::Zero());
  const double bound = outside.norm() - body.sphere_radius() - kRounding;
  return center.allFinite() && at.axis.allFinite() ? bound : -kUnbounded;
}

/// A piece with its place. The points within `rounding` of the core: their distance is that of the core, less
/// `rounding`.
struct PieceInPlace {
  PieceInPlace(const BodyPiece& piece, const AxisPlacement& at) : core(piece.core, at), rounding(piece.rounding) {}

  PlacedFrustum core;
  double rounding;
};

template <class Shape>
Clearance between(const PieceInPlace& piece, const Shape& shape, double sufficient) {
  const Separation found = separation(piece.core, shape, sufficient + piece.rounding + kRounding);
  Clearance result;
  if (found.overlaps()) {
    result.lower = result.upper = -(overlap_depth(piece.core, shape) + piece.rounding);
    result.on_body = found.on_first;
  } else {
    result.lower = found.lower - piece.rounding - kRounding;
    result.upper = found.upper - piece.rounding;
    result.on_body = found.on_first + (piece.rounding / found.upper) * (found.on_second - found.on_first);
    if (result.upper < 0) result.lower = result.upper;
  }
  result.on_obstacle = found.on_second;
  return result;
}

/// All pieces of a body against one convex obstacle. A piece need not be known better than the nearest one so far.
template <class Shape>
Clearance body_to(const RevolvedBody& body, const AxisPlacement& at, const Shape& shape, double sufficient) {
  Clearance nearest;
  for (const BodyPiece& piece : body.pieces())
    include(nearest, between(PieceInPlace(piece, at), shape, std::min(sufficient, nearest.upper)));
  return nearest;
}

Clearance bounded_by(double lower) {
  Clearance result;
  result.lower = lower;
  return result;
}

bool is_usable(double bound) { return bound > -kUnbounded; }

/// The walk through a mesh's tree for one piece of a body.
class MeshSearch {
 public:
  MeshSearch(const Mesh& mesh, const PieceInPlace& piece, double sufficient)
      : mesh_(mesh), piece_(piece), sufficient_(sufficient) {}

  /// Adds what the mesh is to the piece.
  void run(Clearance& nearest) {
    depth_ = 0;
    push(0, bound(mesh_.nodes()[0]));
    while (depth_ > 0) {
      const QueuedNode entry = open_[--depth_];
      if (entry.bound >= limit(nearest)) {
        nearest.lower = std::min(nearest.lower, entry.bound);
        continue;
      }
      const MeshNode& node = mesh_.nodes()[entry.node];
      if (node.count > 0)
        compare(node, nearest);
      else
        push_children(node);
    }
  }

 private:
  struct QueuedNode {
    std::uint32_t node;
    double bound;
  };

  double limit(const Clearance& nearest) const { return std::min(sufficient_, nearest.upper); }

  /// One plane between the piece and the box of a node.
  double bound(const MeshNode& node) const {
    const Cuboid box{node.box.min(), node.box.max()};
    const Vec3 on_box = box.nearest(piece_.core.middle());
    const Vec3 apart = on_box - piece_.core.nearest(on_box);
    const double length = apart.norm();
    if (!(length > 0)) return -kUnbounded;
    const Vec3 n = apart / length;
    return box.lowest(n) - piece_.core.highest(n) - piece_.rounding - kRounding;
  }

  void compare(const MeshNode& node, Clearance& nearest) const {
    for (const Triangle& triangle : mesh_.triangles().subspan(node.first, node.count))
      include(nearest, between(piece_, triangle, limit(nearest)));
  }

  /// The nearer child comes out first.
  void push_children(const MeshNode& node) {
    const double left = bound(mesh_.nodes()[node.first]);
    const double right = bound(mesh_.nodes()[node.first + 1]);
    const bool left_first = left <= right;
    push(left_first ? node.first + 1 : node.first, left_first ? right : left);
    push(left_first ? node.first : node.first + 1, left_first ? left : right);
  }

  void push(std::uint32_t node, double bound) { open_[depth_++] = {node, bound}; }

  const Mesh& mesh_;
  const PieceInPlace& piece_;
  double sufficient_;
  std::array<QueuedNode, 64> open_;  ///< The tree halves its triangles, so that it is at most 31 deep.
  std::size_t depth_ = 0;
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
  Clearance nearest;
  for (const BodyPiece& piece : body.pieces()) {
    const PieceInPlace placed(piece, at);
    MeshSearch(obstacle, placed, sufficient).run(nearest);
  }
  // Apart from the surface, the body is on one side of it as a whole, and so is any point of it.
  if (nearest.lower > 0 && obstacle.encloses(PieceInPlace(body.pieces().front(), at).core.middle())) {
    nearest.lower = -nearest.lower;
    nearest.upper = nearest.lower;
  }
  return nearest;
}

}  // namespace isocnc::solids
