#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "interpreter/solids/clearance.h"
#include "interpreter/solids/separation.h"

/// What clearance() is made of: distances of convex shapes from each other and from meshes. Used in this folder only.
namespace isocnc::solids::detail {

inline constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// Takes the nearer one. Each part of a union bounds the whole by its own distance.
inline void include(Clearance& whole, const Clearance& part) {
  whole.lower = std::min(whole.lower, part.lower);
  if (part.upper < whole.upper) {
    whole.upper = part.upper;
    whole.on_body = part.on_body;
    whole.on_obstacle = part.on_obstacle;
  }
}

inline Clearance bounded_by(double lower) {
  Clearance result;
  result.lower = lower;
  return result;
}

/// A lower bound of the distance between the points of a sphere and those of a box.
inline double sphere_bound(const geometry::Vec3& center, double radius, const BoundingBox& extent) {
  const geometry::Vec3 outside =
      (extent.min() - center).cwiseMax(center - extent.max()).cwiseMax(geometry::Vec3::Zero());
  return outside.norm() - radius - kRounding;
}

/// A lower bound from the sphere around the body and the box around the obstacle. A placement that is not finite gives
/// minus infinity.
inline double coarse_bound(const RevolvedBody& body, const AxisPlacement& at, const BoundingBox& extent) {
  const geometry::Vec3 center = at.at(body.middle());
  const double bound = sphere_bound(center, body.sphere_radius(), extent);
  return center.allFinite() && at.axis.allFinite() ? bound : -kUnbounded;
}

inline bool is_usable(double bound) { return bound > -kUnbounded; }

/// The points within `rounding` of a convex shape: their distance is that of the core, less `rounding`.
template <class Core>
struct RoundedShape {
  Core core;
  double rounding = 0;  ///< mm, not negative.
};

template <class Core>
RoundedShape<Core> rounded(const Core& core, double rounding = 0) {
  return {core, rounding};
}

using PieceInPlace = RoundedShape<PlacedFrustum>;

inline PieceInPlace placed(const BodyPiece& piece, const AxisPlacement& at) {
  return {PlacedFrustum(piece.core, at), piece.rounding};
}

/// Two convex shapes. Where they overlap, both bounds are 0 at most: how deep is not asked for.
template <class Core, class Shape>
Clearance gap(const RoundedShape<Core>& body, const Shape& shape, double sufficient) {
  const Separation found = separation(body.core, shape, sufficient + body.rounding + kRounding);
  Clearance result;
  if (found.overlaps()) {
    result.lower = result.upper = -body.rounding;
    result.on_body = found.on_first;
  } else {
    result.lower = found.lower - body.rounding - kRounding;
    result.upper = found.upper - body.rounding;
    result.on_body = found.on_first + (body.rounding / found.upper) * (found.on_second - found.on_first);
    if (result.upper < 0) result.lower = result.upper;
  }
  result.on_obstacle = found.on_second;
  return result;
}

/// Two convex shapes, with their depth where they overlap.
template <class Core, class Shape>
Clearance between(const RoundedShape<Core>& body, const Shape& shape, double sufficient) {
  Clearance result = gap(body, shape, sufficient);
  if (result.upper <= -body.rounding) result.lower = result.upper = -(overlap(body.core, shape).depth + body.rounding);
  return result;
}

/// The same for a triangle, whose depth is asked for with care only where it may be the deepest: at more than
/// `deepest`.
template <class Core>
Clearance to_triangle(const RoundedShape<Core>& body, const Triangle& triangle, double sufficient, double deepest) {
  Clearance result = between(body, triangle, sufficient);
  if (result.upper <= -body.rounding && result.depth() > deepest)
    result.lower = result.upper = -(overlap(body.core, triangle, true).depth + body.rounding);
  return result;
}

/// A lower bound of the signed distance between what two boxes contain: where the boxes overlap, nothing in them
/// overlaps more than they do.
inline double box_bound(const BoundingBox& a, const BoundingBox& b) {
  const geometry::Vec3 gap = (b.min() - a.max()).cwiseMax(a.min() - b.max());
  const double widest = gap.maxCoeff();
  return (widest > 0 ? gap.cwiseMax(0).norm() : widest) - kRounding;
}

/// The walk through a mesh's tree for one convex shape.
template <class Core>
class MeshSearch {
 public:
  MeshSearch(const Mesh& mesh, const RoundedShape<Core>& body, double sufficient)
      : mesh_(mesh), body_(body), sufficient_(sufficient) {}

  /// Adds what the mesh's surface is to the shape; of a convex mesh, ends where they are found to touch: how deep its
  /// surface is in the shape says nothing of the solid.
  void run(Clearance& nearest) { walk(nearest, mesh_.convex() ? 0 : -kUnbounded); }
  /// The same, but ends where they are found to touch.
  void until_touch(Clearance& nearest) { walk(nearest, 0); }

  /// Calls `use` with each triangle that the shape touches, and where, until it returns false.
  template <class Use>
  void each_touching(Use&& use) {
    depth_ = 0;
    push(0, bound(mesh_.nodes()[0].box));
    while (depth_ > 0) {
      const QueuedNode entry = open_[--depth_];
      if (entry.bound > 0) continue;
      const MeshNode& node = mesh_.nodes()[entry.node];
      if (node.count == 0) {
        push_children(node);
        continue;
      }
      for (const Triangle& triangle : mesh_.triangles().subspan(node.first, node.count)) {
        const Clearance found = gap(body_, triangle, 0);
        if (!(found.upper > 0) && !use(triangle, found)) return;
      }
    }
  }

 private:
  struct QueuedNode {
    std::uint32_t node;
    double bound;
  };

  /// Ends when the nearest distance is `enough` or less.
  void walk(Clearance& nearest, double enough) {
    depth_ = 0;
    push(0, bound(mesh_.nodes()[0].box));
    while (depth_ > 0 && nearest.upper > enough) {
      const QueuedNode entry = open_[--depth_];
      if (entry.bound >= limit(nearest)) {
        nearest.lower = std::min(nearest.lower, entry.bound);
        continue;
      }
      const MeshNode& node = mesh_.nodes()[entry.node];
      if (node.count > 0)
        compare(node, nearest, enough);
      else
        push_children(node);
    }
  }

  double limit(const Clearance& nearest) const { return std::min(sufficient_, nearest.upper); }

  /// One plane between the shape and a box, or how much they overlap along the normals of both.
  double bound(const BoundingBox& extent) const {
    const Cuboid box{extent.min(), extent.max()};
    const geometry::Vec3 on_box = box.nearest(body_.core.middle());
    const geometry::Vec3 apart = on_box - body_.core.nearest(on_box);
    const double length = apart.norm();
    if (!(length > 0)) return overlap_bound(extent);
    const geometry::Vec3 n = apart / length;
    return box.lowest(n) - body_.core.highest(n) - body_.rounding - kRounding;
  }

  /// The gap before the triangle's plane, or along the direction in which the nearest points so far are apart: most
  /// triangles are farther away than those.
  double plane_bound(const Triangle& triangle, const Clearance& nearest) const {
    double widest = -kUnbounded;
    const geometry::Vec3 area = triangle.area_vector();
    if (const double length = area.norm(); length > 0) {
      const geometry::Vec3 normal = area / length;
      widest = std::max(body_.core.lowest(normal) - triangle.highest(normal),
                        triangle.lowest(normal) - body_.core.highest(normal));
    }
    if (nearest.upper > 0 && nearest.upper < kUnbounded) {
      const geometry::Vec3 apart = nearest.on_obstacle - nearest.on_body;
      if (const double length = apart.norm(); length > 0) {
        const geometry::Vec3 n = apart / length;
        widest = std::max(widest, triangle.lowest(n) - body_.core.highest(n));
      }
    }
    return widest - body_.rounding - kRounding;
  }

  /// Nothing in a box overlaps the shape more than the box does.
  double overlap_bound(const BoundingBox& extent) const {
    const Cuboid box{extent.min(), extent.max()};
    double widest = -kUnbounded;
    const auto consider = [&](const geometry::Vec3& n) {
      widest = std::max({widest, box.lowest(n) - body_.core.highest(n), body_.core.lowest(n) - box.highest(n)});
    };
    box.for_each_normal(body_.core.middle(), consider);
    body_.core.for_each_normal(box.middle(), consider);
    return widest - body_.rounding - kRounding;
  }

  void compare(const MeshNode& node, Clearance& nearest, double enough) const {
    for (const Triangle& triangle : mesh_.triangles().subspan(node.first, node.count)) {
      const double needed = limit(nearest);
      if (needed < 0 && overlap_bound(triangle.bounds()) >= needed) continue;
      if (const double bound = plane_bound(triangle, nearest); needed > 0 && bound >= needed) {
        nearest.lower = std::min(nearest.lower, bound);
        continue;
      }
      include(nearest,
              enough < 0 ? to_triangle(body_, triangle, needed, nearest.depth()) : gap(body_, triangle, needed));
    }
  }

  /// The nearer child comes out first.
  void push_children(const MeshNode& node) {
    const double left = bound(mesh_.nodes()[node.first].box);
    const double right = bound(mesh_.nodes()[node.first + 1].box);
    const bool left_first = left <= right;
    push(left_first ? node.first + 1 : node.first, left_first ? right : left);
    push(left_first ? node.first : node.first + 1, left_first ? left : right);
  }

  void push(std::uint32_t node, double bound) { open_[depth_++] = {node, bound}; }

  const Mesh& mesh_;
  const RoundedShape<Core>& body_;
  double sufficient_;
  std::array<QueuedNode, 64> open_;  ///< The tree halves its triangles, so that it is at most 31 deep.
  std::size_t depth_ = 0;
};

/// The clearance where a closed surface encloses what is apart from it. Requires a search for exact distances from the
/// surface, which is made again where `nearest` comes from one that ended early.
template <class Search>
Clearance enclosed(const Clearance& nearest, double sufficient, Search&& search) {
  Clearance result = sufficient < kExact ? search() : nearest;
  result.lower = -result.lower;
  result.upper = result.lower;
  return result;
}

/// The point of a mesh's surface that is nearest to a point.
inline geometry::Vec3 nearest_on_surface(const Mesh& mesh, const geometry::Vec3& point) {
  struct QueuedNode {
    std::uint32_t node;
    double square;  ///< Of the distance from its box.
  };
  const auto queued = [&](std::uint32_t node) -> QueuedNode {
    return {node, mesh.nodes()[node].box.squaredExteriorDistance(point)};
  };
  std::array<QueuedNode, 64> open;  // The tree is at most 31 deep.
  std::size_t depth = 0;
  open[depth++] = queued(0);
  geometry::Vec3 nearest = geometry::Vec3::Zero();
  double square = kUnbounded;
  while (depth > 0) {
    const QueuedNode entry = open[--depth];
    if (!(entry.square < square)) continue;
    const MeshNode& node = mesh.nodes()[entry.node];
    for (const Triangle& triangle : mesh.triangles().subspan(node.first, node.count)) {
      const geometry::Vec3 found = triangle.nearest(point);
      if (const double each = (found - point).squaredNorm(); each < square) {
        square = each;
        nearest = found;
      }
    }
    if (node.count > 0) continue;
    const QueuedNode left = queued(node.first);
    const QueuedNode right = queued(node.first + 1);
    const bool is_left_nearer = left.square <= right.square;
    open[depth++] = is_left_nearer ? right : left;
    open[depth++] = is_left_nearer ? left : right;
  }
  return nearest;
}

/// The deepest of some points of a body in a closed mesh: to be free, the body has to move by their distance from the
/// surface. A triangle is left by a body sideways, and shows no larger depth than about the body's radius.
class DeepPoints {
 public:
  /// `deepest` takes what is deeper than it.
  DeepPoints(const Mesh& mesh, Clearance& deepest) : mesh_(mesh), deepest_(deepest) {}

  /// Points on the axis and on the surface: at the lower end of each piece, and in the middle of what is in the mesh.
  void take(const RevolvedBody& body, const AxisPlacement& at) {
    constexpr int kLines = 8;
    const geometry::Vec3 side = at.axis.unitOrthogonal();
    const geometry::Vec3 other = at.axis.cross(side);
    for (const BodyPiece& piece : body.pieces()) {
      const Frustum& core = piece.core;
      take_line(at.at(core.bottom), at.at(core.top), piece.rounding);
      if (!(std::max(core.bottom_radius, core.top_radius) > 0)) continue;
      for (int i = 0; i < kLines; ++i) {
        const double angle = 2 * std::numbers::pi * i / kLines;
        const geometry::Vec3 outwards = std::cos(angle) * side + std::sin(angle) * other;
        take_line(at.at(core.bottom) + core.bottom_radius * outwards, at.at(core.top) + core.top_radius * outwards,
                  piece.rounding);
      }
    }
  }

  /// The farthest point of the ball of radius `rounding` about a point, mm.
  void take_point(const geometry::Vec3& point, double rounding) {
    const BoundingBox& box = mesh_.bounds();
    const double most = std::min((point - box.min()).minCoeff(), (box.max() - point).minCoeff());
    if (!(most > 0 && most + rounding > deepest_.depth()) || !mesh_.encloses(point)) return;
    const geometry::Vec3 on_surface = nearest_on_surface(mesh_, point);
    const double depth = (on_surface - point).norm() + rounding;
    if (!(depth > deepest_.depth())) return;
    deepest_ = {.lower = -depth, .upper = -depth, .on_body = point, .on_obstacle = on_surface};
  }

 private:
  void take_line(const geometry::Vec3& low, const geometry::Vec3& high, double rounding) {
    take_point(low, rounding);
    // What of the line is in the box around the mesh.
    double from = 0;
    double to = 1;
    const geometry::Vec3 along = high - low;
    for (int i = 0; i < 3; ++i) {
      const double first = (mesh_.bounds().min()[i] - low[i]) / along[i];
      const double last = (mesh_.bounds().max()[i] - low[i]) / along[i];
      if (std::isnan(first) || std::isnan(last)) continue;
      from = std::max(from, std::min(first, last));
      to = std::min(to, std::max(first, last));
    }
    if (from < to) take_point(low + (from + to) / 2 * along, rounding);
  }

  const Mesh& mesh_;
  Clearance& deepest_;
};

}  // namespace isocnc::solids::detail
