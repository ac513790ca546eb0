#pragma once

#include <array>

#include <Eigen/Geometry>

#include "interpreter/geometry/vectors.h"
#include "interpreter/solids/frustum.h"

namespace isocnc::solids {

/// The corners of a box along the axes, mm.
using BoundingBox = Eigen::AlignedBox3d;

/// A box along the axes of its frame, solid. A box that stands askew is given in a frame of its own, to which the
/// caller brings the placement of the body. Has the functions of a convex shape (PlacedFrustum).
struct Cuboid {
  geometry::Vec3 minimum = geometry::Vec3::Zero();  ///< Lower corner, mm.
  geometry::Vec3 maximum = geometry::Vec3::Zero();  ///< Upper corner, mm; nowhere below the lower one.

  double lowest(const geometry::Vec3& n) const { return n.dot(lowest_point(n)); }
  double highest(const geometry::Vec3& n) const { return n.dot(highest_point(n)); }
  geometry::Vec3 lowest_point(const geometry::Vec3& n) const {
    return (n.array() > 0).select(minimum.array(), maximum.array());
  }
  geometry::Vec3 highest_point(const geometry::Vec3& n) const {
    return (n.array() > 0).select(maximum.array(), minimum.array());
  }
  geometry::Vec3 nearest(const geometry::Vec3& point) const { return point.cwiseMax(minimum).cwiseMin(maximum); }
  geometry::Vec3 middle() const { return (minimum + maximum) / 2; }
  BoundingBox bounds() const { return {minimum, maximum}; }

  template <class Use>
  void for_each_normal(const geometry::Vec3& /*other*/, Use&& use) const {
    for (int axis = 0; axis < 3; ++axis) use(geometry::Vec3(geometry::Vec3::Unit(axis)));
  }
  template <class Use>
  void for_each_edge(Use&& use) const {
    for (int axis = 0; axis < 3; ++axis) use(geometry::Vec3(geometry::Vec3::Unit(axis)));
  }
};

/// A solid cylinder about any axis, mm: a suction cup, a pin, a stop.
struct Cylinder {
  AxisPlacement at;   ///< Center of the lower disc, and the direction of the axis.
  double height = 0;  ///< Not negative.
  double radius = 0;  ///< Not negative.

  PlacedFrustum solid() const { return PlacedFrustum({0, radius, height, radius}, at); }
  BoundingBox bounds() const;
};

/// A triangle in space, mm; may be degenerate. Has the functions of a convex shape (PlacedFrustum).
struct Triangle {
  std::array<geometry::Vec3, 3> corners = {geometry::Vec3::Zero(), geometry::Vec3::Zero(), geometry::Vec3::Zero()};

  double lowest(const geometry::Vec3& n) const;
  double highest(const geometry::Vec3& n) const { return -lowest(-n); }
  geometry::Vec3 lowest_point(const geometry::Vec3& n) const;
  geometry::Vec3 highest_point(const geometry::Vec3& n) const { return lowest_point(-n); }
  geometry::Vec3 nearest(const geometry::Vec3& point) const;
  geometry::Vec3 middle() const { return (corners[0] + corners[1] + corners[2]) / 3; }
  BoundingBox bounds() const;
  /// Twice the area, in the direction from which the corners run counterclockwise, mm^2.
  geometry::Vec3 area_vector() const { return (corners[1] - corners[0]).cross(corners[2] - corners[0]); }

  template <class Use>
  void for_each_normal(const geometry::Vec3& /*other*/, Use&& use) const {
    const geometry::Vec3 normal = area_vector();
    if (normal.norm() > 0) use(geometry::Vec3(normal.normalized()));
  }
  template <class Use>
  void for_each_edge(Use&& use) const {
    for (std::size_t i = 0; i < 3; ++i) {
      const geometry::Vec3 edge = corners[(i + 1) % 3] - corners[i];
      if (edge.norm() > 0) use(geometry::Vec3(edge.normalized()));
    }
  }
};

}  // namespace isocnc::solids
