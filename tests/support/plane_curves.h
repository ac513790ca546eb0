#pragma once

#include <algorithm>
#include <cmath>

#include "interpreter/geometry/plane_curve.h"

namespace isocnc::support {

inline geometry::Vec2 turned(const geometry::Vec2& v, double angle) {
  return {v.x() * std::cos(angle) - v.y() * std::sin(angle), v.x() * std::sin(angle) + v.y() * std::cos(angle)};
}

inline geometry::PlaneCurve line(const geometry::Vec2& start, const geometry::Vec2& end) {
  return {.start = start, .end = end};
}

/// The arc from `start` about `center`; `sweep` in radians.
inline geometry::PlaneCurve arc(const geometry::Vec2& start, const geometry::Vec2& center, double sweep) {
  return {.start = start, .end = center + turned(start - center, sweep), .center = center, .sweep = sweep};
}

/// The point after `part`, from 0 to 1, of the curve's length.
inline geometry::Vec2 point_on(const geometry::PlaneCurve& curve, double part) {
  if (!curve.is_arc()) return curve.start + part * (curve.end - curve.start);
  return curve.center + turned(curve.start - curve.center, part * curve.sweep);
}

/// The distance of a point from the nearest point of the curve.
inline double distance_from(const geometry::Vec2& point, const geometry::PlaneCurve& curve) {
  const double to_ends = std::min((point - curve.start).norm(), (point - curve.end).norm());
  if (!curve.is_arc()) {
    const geometry::Vec2 way = curve.end - curve.start;
    const double part = (point - curve.start).dot(way) / way.squaredNorm();
    return part > 0 && part < 1 ? (curve.start + part * way - point).norm() : to_ends;
  }
  const geometry::Vec2 there = turned(curve.start - curve.center, curve.sweep / 2);
  const geometry::Vec2 here = point - curve.center;
  const double off = std::acos(std::clamp(there.dot(here) / (there.norm() * here.norm()), -1.0, 1.0));
  return off < std::abs(curve.sweep) / 2 ? std::abs(here.norm() - curve.radius()) : to_ends;
}

}  // namespace isocnc::support
