#include "interpreter/solids/obstacle.h"

#include <algorithm>

namespace isocnc::solids {

using geometry::Vec3;

BoundingBox Cylinder::bounds() const {
  const PlacedFrustum shape = solid();
  Vec3 low;
  Vec3 high;
  for (int i = 0; i < 3; ++i) {
    high[i] = shape.highest(Vec3::Unit(i));
    low[i] = shape.lowest(Vec3::Unit(i));
  }
  return {low, high};
}

double Triangle::lowest(const Vec3& n) const {
  return std::min({n.dot(corners[0]), n.dot(corners[1]), n.dot(corners[2])});
}

Vec3 Triangle::lowest_point(const Vec3& n) const {
  const double first = n.dot(corners[0]);
  const double second = n.dot(corners[1]);
  const double third = n.dot(corners[2]);
  if (first <= second && first <= third) return corners[0];
  return second <= third ? corners[1] : corners[2];
}

BoundingBox Triangle::bounds() const {
  BoundingBox box(corners[0]);
  box.extend(corners[1]);
  box.extend(corners[2]);
  return box;
}

namespace {

Vec3 nearest_on_edge(const Vec3& from, const Vec3& to, const Vec3& point) {
  const Vec3 along = to - from;
  const double square = along.squaredNorm();
  if (!(square > 0)) return from;
  return from + std::clamp((point - from).dot(along) / square, 0.0, 1.0) * along;
}

}  // namespace

/// In the face where the point is above it, else the nearest on the three edges.
Vec3 Triangle::nearest(const Vec3& point) const {
  const Vec3 normal = area_vector();
  const double square = normal.squaredNorm();
  const Vec3 offset = point - corners[0];
  const double second = normal.dot(offset.cross(corners[2] - corners[0]));
  const double third = normal.dot((corners[1] - corners[0]).cross(offset));
  if (square > 0 && second >= 0 && third >= 0 && second + third <= square)
    return point - normal * (normal.dot(offset) / square);
  Vec3 best = nearest_on_edge(corners[0], corners[1], point);
  for (std::size_t i = 1; i < 3; ++i) {
    const Vec3 other = nearest_on_edge(corners[i], corners[(i + 1) % 3], point);
    if ((other - point).squaredNorm() < (best - point).squaredNorm()) best = other;
  }
  return best;
}

}  // namespace isocnc::solids
