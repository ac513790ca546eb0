#include "interpreter/solids/frustum.h"

#include <algorithm>
#include <cmath>

namespace isocnc::solids {

using geometry::Vec2;
using geometry::Vec3;

namespace {

/// Sine below which two directions count as parallel: a support point is off by this part of the radius at most.
constexpr double kParallel = 1e-9;

/// The point of the line between two points of a plane that is nearest to `point`.
Vec2 nearest_on_line(const Vec2& from, const Vec2& to, const Vec2& point) {
  const Vec2 along = to - from;
  const double square = along.squaredNorm();
  if (!(square > 0)) return from;
  return from + std::clamp((point - from).dot(along) / square, 0.0, 1.0) * along;
}

/// A unit vector across `axis`.
Vec3 any_across(const Vec3& axis) {
  return axis.cross(std::abs(axis.x()) < 0.5 ? Vec3(1, 0, 0) : Vec3(0, 1, 0)).normalized();
}

}  // namespace

PlacedFrustum::PlacedFrustum(const Frustum& shape, const AxisPlacement& at)
    : base_(at.at(shape.bottom)),
      axis_(at.axis),
      height_(shape.top - shape.bottom),
      bottom_radius_(shape.bottom_radius),
      top_radius_(shape.top_radius) {}

/// A disc of radius r about c across the axis a has the maximum n.c + r |n x a|, and a frustum is the hull of two
/// discs. The cross product keeps its digits where n and a are nearly parallel, which sqrt(1 - (n.a)^2) does not.
double PlacedFrustum::highest(const Vec3& n) const {
  const double across = n.cross(axis_).norm();
  return n.dot(base_) + std::max(bottom_radius_ * across, height_ * n.dot(axis_) + top_radius_ * across);
}

Vec3 PlacedFrustum::highest_point(const Vec3& n) const {
  const double along = n.dot(axis_);
  Vec3 outward = n - along * axis_;
  outward -= outward.dot(axis_) * axis_;  // Of a small difference, much may be left along the axis.
  const double across = outward.norm();
  const bool is_top = height_ * along + top_radius_ * across > bottom_radius_ * across;
  const Vec3 center = is_top ? Vec3(base_ + height_ * axis_) : base_;
  if (!(across > kParallel)) return center;
  return center + ((is_top ? top_radius_ : bottom_radius_) / across) * outward;
}

Vec3 PlacedFrustum::nearest(const Vec3& point) const {
  const Vec3 from_base = point - base_;
  const double z = from_base.dot(axis_);
  const Vec3 outward = from_base - z * axis_;
  const double r = outward.norm();
  // In the half plane of the axis and the point, in which the nearest point lies as well: (z, r).
  const Vec2 at(z, r);
  const Vec2 bottom(0, bottom_radius_);
  const Vec2 top(height_, top_radius_);
  if (z >= 0 && z <= height_ && r * height_ <= bottom_radius_ * height_ + (top_radius_ - bottom_radius_) * z &&
      height_ > 0)
    return point;
  Vec2 best = nearest_on_line(bottom, top, at);
  for (const Vec2& rim : {bottom, top}) {
    const Vec2 on_disc(rim.x(), std::min(r, rim.y()));
    if ((on_disc - at).squaredNorm() < (best - at).squaredNorm()) best = on_disc;
  }
  return base_ + best.x() * axis_ + (r > 0 ? best.y() / r : 0.0) * outward;
}

Vec3 PlacedFrustum::side_normal(const Vec3& point) const {
  const Vec3 from_base = point - base_;
  const Vec3 outward = from_base - from_base.dot(axis_) * axis_;
  const Vec3 radial = outward.norm() > kParallel ? Vec3(outward.normalized()) : any_across(axis_);
  const Vec3 normal = height_ * radial + (bottom_radius_ - top_radius_) * axis_;
  return normal.norm() > kParallel ? Vec3(normal.normalized()) : radial;
}

}  // namespace isocnc::solids
