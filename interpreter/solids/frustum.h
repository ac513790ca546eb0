#pragma once

#include "interpreter/geometry/vectors.h"

namespace isocnc::solids {

/// Where a body of revolution stands: the point of its axis at z = 0, and the unit vector in which z grows, both in the
/// frame of the obstacle that it is compared with. A turn about its own axis changes nothing. For a tool, `origin` is
/// the tip and `axis` points from the tip to the spindle.
struct AxisPlacement {
  geometry::Vec3 origin = geometry::Vec3::Zero();  ///< mm
  geometry::Vec3 axis = geometry::Vec3(0, 0, 1);   ///< Unit vector.

  geometry::Vec3 at(double z) const { return origin + z * axis; }
};

/// A solid between two discs across the axis of a body: a cylinder, a cone, a frustum, a disc or a point. All mm.
struct Frustum {
  double bottom = 0;         ///< z of the lower disc.
  double bottom_radius = 0;  ///< Not negative.
  double top = 0;            ///< z of the upper disc, not below `bottom`.
  double top_radius = 0;     ///< Not negative.
};

/// A frustum in space: convex, with the functions that every convex shape of this module has.
///
/// - `highest(n)`: the maximum of n . p over the shape, for a unit vector n; `lowest(n)` the minimum.
/// - `highest_point(n)`, `lowest_point(n)`: a point of the shape that takes this value, up to 1e-9 of the radius.
/// - `nearest(p)`: the point of the shape that is nearest to p; p itself within the shape.
/// - `middle()`: a point of the shape.
class PlacedFrustum {
 public:
  PlacedFrustum(const Frustum& shape, const AxisPlacement& at);

  double highest(const geometry::Vec3& n) const;
  double lowest(const geometry::Vec3& n) const { return -highest(-n); }
  geometry::Vec3 highest_point(const geometry::Vec3& n) const;
  geometry::Vec3 lowest_point(const geometry::Vec3& n) const { return highest_point(-n); }
  geometry::Vec3 nearest(const geometry::Vec3& point) const;
  /// The shape after a translation.
  PlacedFrustum moved(const geometry::Vec3& by) const {
    PlacedFrustum copy = *this;
    copy.base_ += by;
    return copy;
  }
  geometry::Vec3 middle() const { return base_ + (height_ / 2) * axis_; }

  /// Calls `use` with unit vectors along which the shape is likely to leave `other` soonest: its axis, and the normal
  /// of its side that faces the point.
  template <class Use>
  void for_each_normal(const geometry::Vec3& other, Use&& use) const {
    use(axis_);
    use(side_normal(other));
  }
  /// Calls `use` with the directions in which the shape has straight edges. A cylinder has none, but its side is
  /// straight along the axis, which serves the same end: across it and an edge of another shape, both may leave each
  /// other soonest.
  template <class Use>
  void for_each_edge(Use&& use) const {
    use(axis_);
  }

 private:
  geometry::Vec3 side_normal(const geometry::Vec3& point) const;

  geometry::Vec3 base_;  ///< Center of the lower disc.
  geometry::Vec3 axis_;
  double height_;
  double bottom_radius_;
  double top_radius_;
};

}  // namespace isocnc::solids
