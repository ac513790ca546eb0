#include "interpreter/geometry/plane_curve.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace isocnc::geometry {

static constexpr double kTurn = 2 * std::numbers::pi;
static constexpr double kOnCurve = 1e-7;  // mm: distance beyond its ends at which a curve still counts as met.

static Vec2 unit(const Vec2& vector) {
  const double length = vector.norm();
  return length > 0 ? Vec2(vector / length) : Vec2(Vec2::Zero());
}

/// The unit vector along an arc at one of its points.
static Vec2 direction_on_arc(const PlaneCurve& arc, const Vec2& point) {
  return (arc.sweep > 0 ? 1 : -1) * left_of(unit(point - arc.center));
}

double PlaneCurve::length() const { return is_arc() ? radius() * std::abs(sweep) : (end - start).norm(); }

Vec2 PlaneCurve::direction_at_start() const { return direction_at(start); }

Vec2 PlaneCurve::direction_at_end() const { return direction_at(end); }

Vec2 PlaneCurve::direction_at(const Vec2& point) const {
  return is_arc() ? direction_on_arc(*this, point) : unit(end - start);
}

/// The angle of an arc from its start to a point near it: radians in its own sense, from slightly below 0 to a full
/// turn.
static double turned_at(const PlaneCurve& arc, const Vec2& point) {
  const Vec2 a = arc.start - arc.center;
  const Vec2 b = point - arc.center;
  const double angle = std::atan2(cross(a, b), a.dot(b)) * (arc.sweep > 0 ? 1 : -1);
  const double tolerance = kOnCurve / std::max(a.norm(), kOnCurve);
  return angle < -tolerance ? angle + kTurn : angle;
}

PlaneCurve PlaneCurve::from(const Vec2& point, double along) const {
  return {.start = point, .end = end, .center = center, .sweep = is_arc() ? sweep * (1 - along / length()) : 0};
}

PlaneCurve PlaneCurve::to(const Vec2& point, double along) const {
  return {.start = start, .end = point, .center = center, .sweep = is_arc() ? sweep * along / length() : 0};
}

bool vanishes_beside(const PlaneCurve& curve, double distance) {
  return curve.is_arc() && distance * curve.sweep > 0 && curve.radius() <= std::abs(distance);
}

PlaneCurve beside(const PlaneCurve& curve, double distance) {
  PlaneCurve shifted = curve;
  shifted.start += distance * left_of(curve.direction_at_start());
  shifted.end += distance * left_of(curve.direction_at_end());
  if (vanishes_beside(curve, distance)) shifted.sweep = 0;
  return shifted;
}

/// Length of the curve before a point of its infinite line or full circle; nothing if the point is not on the curve.
static std::optional<double> length_before(const PlaneCurve& curve, const Vec2& point) {
  const double length = curve.length();
  if (!(length > 0)) return std::nullopt;
  const double before =
      curve.is_arc() ? turned_at(curve, point) * curve.radius() : (point - curve.start).dot(curve.direction_at_start());
  if (!(before >= -kOnCurve && before <= length + kOnCurve)) return std::nullopt;
  return std::clamp(before, 0.0, length);
}

static void add_crossing(Crossings& found, const PlaneCurve& first, const PlaneCurve& second, const Vec2& point) {
  const auto along_first = length_before(first, point);
  const auto along_second = length_before(second, point);
  if (!along_first || !along_second) return;
  found.at[static_cast<std::size_t>(found.count++)] = {point, *along_first, *along_second};
}

/// Adds the points where the infinite line of `line` meets the circle of `arc`.
static void cross_line_and_circle(const PlaneCurve& line, const PlaneCurve& arc, const auto& add) {
  const Vec2 way = line.direction_at_start();
  const double radius = arc.radius();
  const double off = cross(way, line.start - arc.center);
  if (!(std::abs(off) <= radius)) return;
  const Vec2 foot = arc.center + off * left_of(way);
  const double half = std::sqrt(std::max(radius * radius - off * off, 0.0));
  add(Vec2(foot - half * way));
  if (half > 0) add(Vec2(foot + half * way));
}

static void cross_circles(const PlaneCurve& first, const PlaneCurve& second, const auto& add) {
  const Vec2 between = second.center - first.center;
  const double apart = between.norm();
  const double r1 = first.radius();
  const double r2 = second.radius();
  if (!(apart > 0) || apart > r1 + r2 || apart < std::abs(r1 - r2)) return;
  const double along = (apart * apart + r1 * r1 - r2 * r2) / (2 * apart);
  const double half = std::sqrt(std::max(r1 * r1 - along * along, 0.0));
  const Vec2 way = between / apart;
  const Vec2 foot = first.center + along * way;
  add(Vec2(foot - half * left_of(way)));
  if (half > 0) add(Vec2(foot + half * left_of(way)));
}

Crossings crossings(const PlaneCurve& first, const PlaneCurve& second) {
  Crossings found;
  const auto add = [&](const Vec2& point) { add_crossing(found, first, second, point); };
  if (first.is_arc() && second.is_arc()) {
    cross_circles(first, second, add);
  } else if (first.is_arc()) {
    cross_line_and_circle(second, first, add);
  } else if (second.is_arc()) {
    cross_line_and_circle(first, second, add);
  } else {
    const Vec2 way = first.direction_at_start();
    const double slope = cross(way, second.direction_at_start());
    constexpr double kParallel = 1e-12;
    if (std::abs(slope) <= kParallel) return found;
    add(first.start + cross(second.start - first.start, second.direction_at_start()) / slope * way);
  }
  return found;
}

static Vec2 nearest_on(const PlaneCurve& curve, const Vec2& point) {
  Vec2 nearest = (point - curve.start).norm() <= (point - curve.end).norm() ? curve.start : curve.end;
  const bool is_center = curve.is_arc() && point == curve.center;  // All points of the arc are equally near.
  if (is_center || !length_before(curve, point)) return nearest;
  const Vec2 way = curve.direction_at_start();
  const Vec2 foot = curve.is_arc() ? Vec2(curve.center + curve.radius() * unit(point - curve.center))
                                   : Vec2(curve.start + way.dot(point - curve.start) * way);
  return (point - foot).norm() < (point - nearest).norm() ? foot : nearest;
}

/// Adds the points of an arc where a common normal of both curves can stand: towards the other's center, or at right
/// angles to its line.
static void add_feet_of_normals(const PlaneCurve& arc, const PlaneCurve& other, const auto& add) {
  const Vec2 towards = other.is_arc() ? unit(other.center - arc.center) : left_of(other.direction_at_start());
  for (const double way : {arc.radius(), -arc.radius()}) {
    const Vec2 point = arc.center + way * towards;
    if (length_before(arc, point)) add(point);
  }
}

Approach approach(const PlaneCurve& first, const PlaneCurve& second) {
  const Crossings crossed = crossings(first, second);
  if (crossed.count > 0) return {crossed.at[0].point, crossed.at[0].point};
  Approach nearest{first.start, nearest_on(second, first.start)};
  const auto consider = [&](const Approach& other) {
    if (other.distance() < nearest.distance()) nearest = other;
  };
  const auto consider_on_first = [&](const Vec2& point) { consider({point, nearest_on(second, point)}); };
  const auto consider_on_second = [&](const Vec2& point) { consider({nearest_on(first, point), point}); };
  consider_on_first(first.end);
  consider_on_second(second.start);
  consider_on_second(second.end);
  if (first.is_arc()) add_feet_of_normals(first, second, consider_on_first);
  if (second.is_arc()) add_feet_of_normals(second, first, consider_on_second);
  return nearest;
}

}  // namespace isocnc::geometry
