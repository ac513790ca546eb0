#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "interpreter/solids/convex_clearance.h"
#include "interpreter/solids/mesh.h"

/// Convex shapes that are made of others, with the functions of a convex shape (PlacedFrustum). Used in this folder
/// only.
namespace isocnc::solids::detail {

/// The convex hull of pieces of a body of revolution.
class PieceHull {
 public:
  /// At least one piece, all about one axis.
  explicit PieceHull(std::vector<PieceInPlace> pieces) : pieces_(std::move(pieces)) {}

  const std::vector<PieceInPlace>& pieces() const { return pieces_; }

  double highest(const geometry::Vec3& n) const {
    const PieceInPlace& piece = highest_piece(n);
    return piece.core.highest(n) + piece.rounding;
  }
  double lowest(const geometry::Vec3& n) const { return -highest(-n); }
  geometry::Vec3 highest_point(const geometry::Vec3& n) const {
    const PieceInPlace& piece = highest_piece(n);
    return piece.core.highest_point(n) + piece.rounding * n;
  }
  geometry::Vec3 lowest_point(const geometry::Vec3& n) const { return highest_point(-n); }
  /// The nearest point of the pieces: of the hull, another one may be nearer.
  geometry::Vec3 nearest(const geometry::Vec3& point) const {
    geometry::Vec3 best = nearest_of(pieces_.front(), point);
    for (const PieceInPlace& piece : pieces_) {
      const geometry::Vec3 found = nearest_of(piece, point);
      if ((found - point).squaredNorm() < (best - point).squaredNorm()) best = found;
    }
    return best;
  }
  geometry::Vec3 middle() const { return pieces_.front().core.middle(); }
  PieceHull moved(const geometry::Vec3& by) const {
    PieceHull copy = *this;
    for (PieceInPlace& piece : copy.pieces_) piece.core = piece.core.moved(by);
    return copy;
  }

  template <class Use>
  void for_each_normal(const geometry::Vec3& other, Use&& use) const {
    for (const PieceInPlace& piece : pieces_) piece.core.for_each_normal(other, use);
  }
  template <class Use>
  void for_each_edge(Use&& use) const {
    pieces_.front().core.for_each_edge(use);
  }

  /// The nearest point of one piece.
  static geometry::Vec3 nearest_of(const PieceInPlace& piece, const geometry::Vec3& point) {
    const geometry::Vec3 on_core = piece.core.nearest(point);
    const geometry::Vec3 outwards = point - on_core;
    const double distance = outwards.norm();
    return distance <= piece.rounding ? point : geometry::Vec3(on_core + (piece.rounding / distance) * outwards);
  }

 private:
  const PieceInPlace& highest_piece(const geometry::Vec3& n) const {
    const auto height = [&](const PieceInPlace& piece) { return piece.core.highest(n) + piece.rounding; };
    return *std::max_element(pieces_.begin(), pieces_.end(),
                             [&](const PieceInPlace& a, const PieceInPlace& b) { return height(a) < height(b); });
  }

  std::vector<PieceInPlace> pieces_;
};

/// All that a convex shape covers on a straight way.
template <class Core>
class SweptHull {
 public:
  SweptHull(Core core, geometry::Vec3 way) : core_(std::move(core)), way_(std::move(way)) {}

  double highest(const geometry::Vec3& n) const { return core_.highest(n) + std::max(0.0, n.dot(way_)); }
  double lowest(const geometry::Vec3& n) const { return core_.lowest(n) + std::min(0.0, n.dot(way_)); }
  geometry::Vec3 highest_point(const geometry::Vec3& n) const { return core_.highest_point(n) + ahead(n); }
  geometry::Vec3 lowest_point(const geometry::Vec3& n) const { return core_.lowest_point(n) + ahead(-n); }
  /// A point that is near to `point`: the nearest one of the shape where it is, and the nearest place on the way for
  /// that, in turn.
  geometry::Vec3 nearest(const geometry::Vec3& point) const {
    constexpr int kRounds = 3;
    const double square = way_.squaredNorm();
    const auto along = [&](const geometry::Vec3& from) {
      return square > 0 ? std::clamp((point - from).dot(way_) / square, 0.0, 1.0) : 0.0;
    };
    double part = along(core_.middle());
    geometry::Vec3 on_core = core_.nearest(point - part * way_);
    for (int i = 1; i < kRounds; ++i) {
      part = along(on_core);
      on_core = core_.nearest(point - part * way_);
    }
    return on_core + part * way_;
  }
  geometry::Vec3 middle() const { return core_.middle() + way_ / 2; }
  SweptHull moved(const geometry::Vec3& by) const { return {core_.moved(by), way_}; }

  template <class Use>
  void for_each_normal(const geometry::Vec3& other, Use&& use) const {
    core_.for_each_normal(other, use);
  }
  template <class Use>
  void for_each_edge(Use&& use) const {
    core_.for_each_edge(use);
    const double length = way_.norm();
    if (length > 0) use(geometry::Vec3(way_ / length));
  }

 private:
  geometry::Vec3 ahead(const geometry::Vec3& n) const {
    return n.dot(way_) > 0 ? way_ : geometry::Vec3(geometry::Vec3::Zero());
  }

  Core core_;
  geometry::Vec3 way_;
};

/// What a convex mesh encloses, at a placement.
class PlacedConvexMesh {
 public:
  /// Requires mesh.convex(), and refers to the mesh.
  PlacedConvexMesh(const Mesh& mesh, const Placement& at) : mesh_(mesh), at_(at) {}

  double highest(const geometry::Vec3& n) const { return n.dot(highest_point(n)); }
  double lowest(const geometry::Vec3& n) const { return n.dot(highest_point(-n)); }
  geometry::Vec3 highest_point(const geometry::Vec3& n) const {
    const geometry::Vec3 inside = at_.linear().transpose() * n;
    const auto& corners = mesh_.convex()->corners;
    return at_ * *std::max_element(
                     corners.begin(), corners.end(),
                     [&](const geometry::Vec3& a, const geometry::Vec3& b) { return inside.dot(a) < inside.dot(b); });
  }
  geometry::Vec3 lowest_point(const geometry::Vec3& n) const { return highest_point(-n); }
  geometry::Vec3 nearest(const geometry::Vec3& point) const;
  geometry::Vec3 middle() const { return at_ * mesh_.convex()->middle; }
  PlacedConvexMesh moved(const geometry::Vec3& by) const {
    PlacedConvexMesh copy = *this;
    copy.at_.translation() += by;
    return copy;
  }

  template <class Use>
  void for_each_normal(const geometry::Vec3& /*other*/, Use&& use) const {
    for (const geometry::Vec3& normal : mesh_.convex()->normals) use(geometry::Vec3(at_.linear() * normal));
  }
  template <class Use>
  void for_each_edge(Use&& use) const {
    for (const geometry::Vec3& edge : mesh_.convex()->edges) use(geometry::Vec3(at_.linear() * edge));
  }

 private:
  const Mesh& mesh_;
  Placement at_;
};

inline geometry::Vec3 PlacedConvexMesh::nearest(const geometry::Vec3& point) const {
  const geometry::Vec3 inside = at_.inverse() * point;
  const ConvexSolid& solid = *mesh_.convex();
  bool is_inside = true;
  for (std::size_t i = 0; i < solid.normals.size(); ++i)
    is_inside = is_inside && solid.normals[i].dot(inside) <= solid.heights[i];
  if (is_inside) return point;
  geometry::Vec3 best = solid.corners.front();
  for (const Triangle& triangle : mesh_.triangles()) {
    const geometry::Vec3 found = triangle.nearest(inside);
    if ((found - inside).squaredNorm() < (best - inside).squaredNorm()) best = found;
  }
  return at_ * best;
}

}  // namespace isocnc::solids::detail
