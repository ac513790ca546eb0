#include "interpreter/stock/line_chord.h"

#include <algorithm>
#include <cmath>

namespace isocnc::stock {

using geometry::Vec2;
using geometry::Vec3;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr HeightInterval kWholeLine{-kInfinity, kInfinity};
constexpr double kFlat = 1e-14;  ///< Below this, a coefficient of a quadratic function counts as 0.

/// Where from + slope z is in [low, high].
HeightInterval where_between(double from, double slope, double low, double high) {
  if (std::abs(slope) < kFlat) return from >= low && from <= high ? kWholeLine : HeightInterval();
  const double one = (low - from) / slope;
  const double other = (high - from) / slope;
  return {std::min(one, other), std::max(one, other)};
}

/// Where a z^2 + 2 b z + c <= 0. For a < 0 these are two rays, of which `upper` chooses one.
HeightInterval where_negative(double a, double b, double c, bool upper) {
  if (std::abs(a) < kFlat) {
    if (std::abs(b) < kFlat) return c <= 0 ? kWholeLine : HeightInterval();
    const double root = -c / (2 * b);
    return b > 0 ? HeightInterval{-kInfinity, root} : HeightInterval{root, kInfinity};
  }
  const double discriminant = b * b - a * c;
  if (!(discriminant >= 0)) return a < 0 ? kWholeLine : HeightInterval();
  // Without the difference of two numbers that are nearly equal.
  const double q = -(b + std::copysign(std::sqrt(discriminant), b));
  const double one = q / a;
  const double other = q != 0 ? c / q : one;
  const double low = std::min(one, other);
  const double high = std::max(one, other);
  if (a > 0) return {low, high};
  return upper ? HeightInterval{high, kInfinity} : HeightInterval{-kInfinity, low};
}

}  // namespace

/// With w = (line, 0) - base, a point of the line is h = w.a + z a_z along the axis, and its square distance from the
/// axis is |w|^2 + z^2 + 2 z w_z - h^2. It is within the cone where that is at most (r + k h)^2.
HeightInterval chord(const solids::Frustum& frustum, const solids::AxisPlacement& at, const Vec2& line) {
  const Vec3 base = at.at(frustum.bottom);
  const Vec3 w(line.x() - base.x(), line.y() - base.y(), -base.z());
  const double height = frustum.top - frustum.bottom;
  const double h = w.dot(at.axis);
  const double slope = at.axis.z();
  HeightInterval result = where_between(h, slope, 0, height);
  if (!(result.bottom <= result.top)) return {};
  if (!(height > 0)) return {};
  const double k = (frustum.top_radius - frustum.bottom_radius) / height;
  const double r = frustum.bottom_radius + k * h;
  const double k_slope = k * slope;
  // Across the axis: the distance vector is p + z q.
  const Vec3 p = w - h * at.axis;
  const Vec3 q = Vec3(0, 0, 1) - slope * at.axis;
  const double a = q.squaredNorm() - k_slope * k_slope;
  const double b = p.dot(q) - r * k_slope;
  const double c = p.squaredNorm() - r * r;
  result.clip(where_negative(a, b, c, k_slope > 0));
  return result.is_empty() ? HeightInterval() : result;
}

/// The z of a sphere about from + s along, s in [0, 1], is z(s) +- sqrt(radius^2 - distance(s)^2). Both are concave or
/// convex, with their extremes where the slope of the line meets that of the sphere, or at an end.
HeightInterval capsule_chord(const Vec3& from, const Vec3& to, double radius, const Vec2& line) {
  const Vec3 along = to - from;
  const Vec2 flat = along.head<2>();
  const double length = flat.norm();
  const Vec2 to_line = line - from.head<2>();
  if (!(length > 0)) {
    const double square = radius * radius - to_line.squaredNorm();
    if (!(square > 0)) return {};
    const double reach = std::sqrt(square);
    return {std::min(from.z(), to.z()) - reach, std::max(from.z(), to.z()) + reach};
  }
  const Vec2 direction = flat / length;
  const double foot = to_line.dot(direction);
  const double aside = to_line.x() * direction.y() - to_line.y() * direction.x();
  const double square = radius * radius - aside * aside;
  if (!(square > 0)) return {};
  const double half = std::sqrt(square);
  const double first = std::max(0.0, foot - half);
  const double last = std::min(length, foot + half);
  if (!(first <= last)) return {};
  const double slope = along.z() / length;
  const double shift = slope * half / std::sqrt(1 + slope * slope);
  const auto reach_at = [&](double t) {
    const double u = t - foot;
    return std::sqrt(std::max(0.0, square - u * u));
  };
  const double lowest = std::clamp(foot - shift, first, last);
  const double highest = std::clamp(foot + shift, first, last);
  return {from.z() + slope * lowest - reach_at(lowest), from.z() + slope * highest + reach_at(highest)};
}

}  // namespace isocnc::stock
