#pragma once

#include <array>

#include "interpreter/geometry/vectors.h"

namespace isocnc::geometry {

/// A line or an arc in a plane, mm. An arc whose ends are not equally far from its center runs through both, as those
/// within the arc tolerance do (D35).
struct PlaneCurve {
  Vec2 start = Vec2::Zero();
  Vec2 end = Vec2::Zero();
  Vec2 center = Vec2::Zero();  ///< Arcs.
  double sweep = 0;            ///< Arcs: radians, positive counterclockwise, in [-2 pi, 2 pi]. 0: a line.

  bool is_arc() const { return sweep != 0; }
  double radius() const { return (start - center).norm(); }
  double length() const;
  /// Unit vectors along the way; zero where a line goes nowhere.
  Vec2 direction_at_start() const;
  Vec2 direction_at_end() const;
  /// At one of its points.
  Vec2 direction_at(const Vec2& point) const;
  /// What of it lies behind or before a point on it, so many mm along its way.
  PlaneCurve from(const Vec2& point, double along) const;
  PlaneCurve to(const Vec2& point, double along) const;
};

/// A quarter turn to the left.
inline Vec2 left_of(const Vec2& direction) { return {-direction.y(), direction.x()}; }

/// The z of the cross product: positive where `b` points to the left of `a`.
inline double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// The curve beside this one, to the left of its way, or for negative distances to the right. Of an arc that is no
/// larger than that, what remains is the line between the points beside its ends.
PlaneCurve beside(const PlaneCurve& curve, double distance);

/// Whether beside() leaves nothing of an arc.
bool vanishes_beside(const PlaneCurve& curve, double distance);

/// A point that two curves share, and how much of each lies before it, mm.
struct Crossing {
  Vec2 point = Vec2::Zero();
  double along_first = 0;
  double along_second = 0;
};

/// Two at most. Curves that run along each other, or merely touch to within rounding, may have none.
struct Crossings {
  std::array<Crossing, 2> at;
  int count = 0;

  const Crossing* begin() const { return at.data(); }
  const Crossing* end() const { return at.data() + count; }
};
Crossings crossings(const PlaneCurve& first, const PlaneCurve& second);

/// Two points that are as near to each other as any of two curves; one and the same where they cross.
struct Approach {
  Vec2 on_first = Vec2::Zero();
  Vec2 on_second = Vec2::Zero();

  double distance() const { return (on_first - on_second).norm(); }
};
Approach approach(const PlaneCurve& first, const PlaneCurve& second);

}  // namespace isocnc::geometry
