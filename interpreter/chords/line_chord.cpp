#include "interpreter/chords/line_chord.h"

#include <algorithm>
#include <cmath>

#include "interpreter/chords/vector_loops.h"

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

CapsuleChord::CapsuleChord(const Vec3& from, const Vec3& to, double radius)
    : x_(from.x()), y_(from.y()), low_(from.z()), high_(from.z()), square_(radius * radius) {
  const Vec3 along = to - from;
  length_ = along.head<2>().norm();
  if (length_ > 0) {
    direction_x_ = along.x() / length_;
    direction_y_ = along.y() / length_;
    slope_ = along.z() / length_;
    lean_ = slope_ / std::sqrt(1 + slope_ * slope_);
  } else {
    low_ = std::min(from.z(), to.z());
    high_ = std::max(from.z(), to.z());
  }
}

CapsuleChord::SegmentPlace CapsuleChord::place(double dx, double dy) const {
  const double aside = dx * direction_y_ - dy * direction_x_;
  return {dx * direction_x_ + dy * direction_y_, square_ - aside * aside};
}

/// The z of a sphere about from + s along, s in [0, 1], is z(s) +- sqrt(radius^2 - distance(s)^2). Both are concave or
/// convex, with their extremes where the slope of the line meets that of the sphere, or at an end. Without a branch, so
/// that a loop over it becomes vectors.
HeightInterval CapsuleChord::chord(const SegmentPlace& at, double half) const {
  const double first = at.foot - half > 0 ? at.foot - half : 0.0;
  const double last = at.foot + half < length_ ? at.foot + half : length_;
  const double shift = lean_ * half;
  const double low = at.foot - shift > first ? at.foot - shift : first;
  const double high = at.foot + shift > first ? at.foot + shift : first;
  const double lowest = low < last ? low : last;
  const double highest = high < last ? high : last;
  const double before = lowest - at.foot;
  const double after = highest - at.foot;
  const bool is_met = at.square > 0 && first <= last;
  const double bottom = low_ + slope_ * lowest - square_root(at.square - before * before);
  const double top = high_ + slope_ * highest + square_root(at.square - after * after);
  return {is_met ? bottom : kInfinity, is_met ? top : -kInfinity};
}

HeightInterval CapsuleChord::of(const Vec2& line) const {
  const SegmentPlace at = place(line.x() - x_, line.y() - y_);
  return chord(at, square_root(at.square));
}

ISOCNC_VECTOR_CLONES void CapsuleChord::of_row(double x, double step, double y, int count, float* bottoms,
                                               float* tops) const {
  const CapsuleChord self = *this;
  for (int i = 0; i < count; ++i) {
    const SegmentPlace at = self.place(x - self.x_ + i * step, y - self.y_);
    const HeightInterval z = self.chord(at, square_root(at.square));
    bottoms[i] = float_above(z.bottom);
    tops[i] = float_below(z.top);
  }
}

}  // namespace isocnc::chords
