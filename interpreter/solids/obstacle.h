#pragma once

#include <array>

#include <Eigen/Geometry>

#include "interpreter/geometry/vectors.h"
#include "interpreter/solids/frustum.h"

namespace isocnc::solids {

/// The corners of a box along the axes, mm.
using BoundingBox = Eigen::AlignedBox3d;

/// Where a solid stands in the frame of the obstacle that it is compared with: a rotation and a translation, mm.
using Placement = Eigen::Isometry3d;

class PlacedCuboid;

/// A box along the axes of its frame, solid. A box that stands askew is given in a frame of its own, to which the
/// caller brings the placement of the body; or it is a PlacedCuboid. Has the functions of a convex shape
/// (PlacedFrustum).
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
  PlacedCuboid placed(const Placement& in) const;
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

/// A box in space, in any direction. Has the functions of a convex shape (PlacedFrustum).
class PlacedCuboid {
 public:
  PlacedCuboid(const Cuboid& shape, const Placement& at)
      : middle_(at * shape.middle()), axes_(at.linear()), half_((shape.maximum - shape.minimum) / 2) {}

  double highest(const geometry::Vec3& n) const {
    return n.dot(middle_) + geometry::Vec3(axes_.transpose() * n).cwiseAbs().dot(half_);
  }
  double lowest(const geometry::Vec3& n) const { return -highest(-n); }
  geometry::Vec3 highest_point(const geometry::Vec3& n) const {
    const geometry::Vec3 along = axes_.transpose() * n;
    const geometry::Vec3 corner = (along.array() > 0).select(half_.array(), -half_.array());
    return middle_ + axes_ * corner;
  }
  geometry::Vec3 lowest_point(const geometry::Vec3& n) const { return highest_point(-n); }
  geometry::Vec3 nearest(const geometry::Vec3& point) const {
    const geometry::Vec3 inside = axes_.transpose() * (point - middle_);
    return middle_ + axes_ * geometry::Vec3(inside.cwiseMax(-half_).cwiseMin(half_));
  }
  PlacedCuboid moved(const geometry::Vec3& by) const {
    PlacedCuboid copy = *this;
    copy.middle_ += by;
    return copy;
  }
  const geometry::Vec3& middle() const { return middle_; }

  template <class Use>
  void for_each_normal(const geometry::Vec3& /*other*/, Use&& use) const {
    for_each_edge(use);
  }
  template <class Use>
  void for_each_edge(Use&& use) const {
    for (int axis = 0; axis < 3; ++axis) use(geometry::Vec3(axes_.col(axis)));
  }

 private:
  geometry::Vec3 middle_;
  geometry::Mat3 axes_;  ///< Columns: the directions of its edges.
  geometry::Vec3 half_;  ///< Half its size along each, mm.
};

inline PlacedCuboid Cuboid::placed(const Placement& in) const { return PlacedCuboid(*this, in); }

/// A solid cylinder about any axis, mm: a suction cup, a pin, a stop.
struct Cylinder {
  AxisPlacement at;   ///< Center of the lower disc, and the direction of the axis.
  double height = 0;  ///< Not negative.
  double radius = 0;  ///< Not negative.

  PlacedFrustum solid() const { return PlacedFrustum({0, radius, height, radius}, at); }
  PlacedFrustum placed(const Placement& in) const {
    return PlacedFrustum({0, radius, height, radius}, {in * at.origin, in.linear() * at.axis});
  }
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
  Triangle moved(const geometry::Vec3& by) const { return {{corners[0] + by, corners[1] + by, corners[2] + by}}; }
  Triangle placed(const Placement& in) const { return {{in * corners[0], in * corners[1], in * corners[2]}}; }
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
