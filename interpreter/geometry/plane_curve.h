#pragma once

#include <array>

#include "interpreter/geometry/vectors.h"

namespace isocnc::geometry {

/// A line or an arc in a plane, mm. An arc runs through both ends, even if they are not equally far from its center, as
/// the arc tolerance allows (D35).
struct PlaneCurve {
  Vec2 start = Vec2::Zero();
  Vec2 end = Vec2::Zero();
  Vec2 center = Vec2::Zero();  ///< Arcs.
  double sweep = 0;            ///< Arcs: radians, positive counterclockwise, in [-2 pi, 2 pi]. 0: a line.

  bool is_arc() const { return sweep != 0; }
  double radius() const { return (start - center).norm(); }
  double length() const;
  /// Unit vectors along the path; zero for a line of length 0.
  Vec2 direction_at_start() const;
  Vec2 direction_at_end() const;
  /// The unit vector along the path at one of its points.
  Vec2 direction_at(const Vec2& point) const;
  /// The part of the curve after (from) or before (to) a point at the arc length `along`, mm.
  PlaneCurve from(const Vec2& point, double along) const;
  PlaneCurve to(const Vec2& point, double along) const;
};

/// A quarter turn to the left.
inline Vec2 left_of(const Vec2& direction) { return {-direction.y(), direction.x()}; }

/// The z of the cross product: positive where `b` points to the left of `a`.
inline double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// The curve at a distance (mm) to the left of this one; for negative distances to the right. An arc with a radius not
/// above the distance becomes the line between the offset ends.
PlaneCurve beside(const PlaneCurve& curve, double distance);

/// Whether beside() turns an arc into a line.
bool vanishes_beside(const PlaneCurve& curve, double distance);

/// A point that two curves share, and the length of each before it, mm.
struct Crossing {
  Vec2 point = Vec2::Zero();
  double along_first = 0;
  double along_second = 0;
};

/// At most two crossings. Curves that overlap, or that touch only within rounding, may have none.
struct Crossings {
  std::array<Crossing, 2> at;
  int count = 0;

  const Crossing* begin() const { return at.data(); }
  const Crossing* end() const { return at.data() + count; }
};
Crossings crossings(const PlaneCurve& first, const PlaneCurve& second);

/// The points of two curves that are nearest to each other; the same point where the curves cross.
struct Approach {
  Vec2 on_first = Vec2::Zero();
  Vec2 on_second = Vec2::Zero();

  double distance() const { return (on_first - on_second).norm(); }
};
Approach approach(const PlaneCurve& first, const PlaneCurve& second);

}  // namespace isocnc::geometry
