#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "interpreter/solids/convex_clearance.h"

/// Used in this folder only.
namespace isocnc::solids::detail {

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
    Clearance found;
    const auto place = rounded(PlacedFrustum({0, 0, 0, 0}, {point, geometry::Vec3::UnitZ()}));
    MeshSearch(mesh_, place, kExact).run(found);
    const double depth = found.upper + rounding;
    if (!(depth > deepest_.depth())) return;
    deepest_ = {.lower = -depth, .upper = -depth, .on_body = point, .on_obstacle = found.on_obstacle};
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
