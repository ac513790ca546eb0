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
class CapsuleChord {
 public:
  CapsuleChord(const geometry::Vec3& from, const geometry::Vec3& to, double radius);
  HeightInterval of(const geometry::Vec2& line) const;
  /// Of the `count` lines at x, x + step, and so on, all at y. The ends are rounded to floats within the interval;
  /// where there is none, the bottom is above the top.
  void of_row(double x, double step, double y, int count, float* bottoms, float* tops) const;

 private:
  /// A line, seen from above: where it is along the segment, and the square of half the sphere's width there.
  struct SegmentPlace {
    double foot;
    double square;
  };
  SegmentPlace place(double dx, double dy) const;
  HeightInterval chord(const SegmentPlace& at, double half) const;

  double x_;
  double y_;
  double low_;  ///< z at the start; of a vertical segment, the least and the greatest one.
  double high_;
  double square_;
  double length_;  ///< Seen from above.
  double direction_x_ = 1;
  double direction_y_ = 0;
  double slope_ = 0;
  double lean_ = 0;  ///< The sine of that slope.
};

}  // namespace isocnc::chords
