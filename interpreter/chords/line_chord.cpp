#include "interpreter/chords/line_chord.h"

#include <algorithm>
#include <cmath>

namespace isocnc::chords {

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
/// axis is |w + z e|^2 - h^2 for the vertical unit vector e. It is within the cone where that is at most (r + k h)^2.
FrustumChord::FrustumChord(const solids::Frustum& frustum, const solids::AxisPlacement& at)
    : base_(at.at(frustum.bottom)),
      axis_(at.axis),
      height_(frustum.top - frustum.bottom),
      radius_(frustum.bottom_radius),
      slope_(at.axis.z()) {
  if (height_ > 0) k_ = (frustum.top_radius - frustum.bottom_radius) / height_;
  k_slope_ = k_ * slope_;
  a_ = axis_.head<2>().squaredNorm() - k_slope_ * k_slope_;
}

HeightInterval FrustumChord::of(const Vec2& line) const {
  if (!(height_ > 0)) return {};
  const Vec3 w(line.x() - base_.x(), line.y() - base_.y(), -base_.z());
  const double h = w.dot(axis_);
  HeightInterval result = where_between(h, slope_, 0, height_);
  if (!(result.bottom <= result.top)) return {};
  const double r = radius_ + k_ * h;
  result.clip(where_negative(a_, w.z() - h * slope_ - r * k_slope_, w.squaredNorm() - h * h - r * r, k_slope_ > 0));
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

}  // namespace isocnc::chords
