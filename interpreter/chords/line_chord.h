#pragma once

#include "interpreter/chords/height_interval.h"
#include "interpreter/geometry/vectors.h"
#include "interpreter/solids/frustum.h"

/// Where a vertical line meets convex bodies in any direction, in closed form. Lines are given by their x and y.
namespace isocnc::chords {

/// Of a frustum, with all that does not depend on the line computed once.
class FrustumChord {
 public:
  FrustumChord(const solids::Frustum& frustum, const solids::AxisPlacement& at);
  HeightInterval of(const geometry::Vec2& line) const;

 private:
  geometry::Vec3 base_;
  geometry::Vec3 axis_;
  double height_;
  double radius_;   ///< At the base.
  double k_ = 0;    ///< Its growth along the axis.
  double slope_;    ///< Growth of the place along the axis with z.
  double k_slope_;  ///< Growth of the radius with z.
  double a_;        ///< Coefficient of z^2 of the square distance from the side.
};

/// Of a sphere that moves along a segment. Both ends may be the same.
HeightInterval capsule_chord(const geometry::Vec3& from, const geometry::Vec3& to, double radius,
                             const geometry::Vec2& line);

}  // namespace isocnc::chords
