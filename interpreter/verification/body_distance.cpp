#include "interpreter/verification/body_distance.h"

#include <algorithm>
#include <cmath>

namespace isocnc::verification {

using geometry::Vec3;

/// A point of the face that is on the way out from a point inside, or near it where the way is not known.
static Vec3 on_surface(const solids::Cuboid& box, const Vec3& inside, const Vec3& way_out) {
  if (!way_out.isZero(0)) {
    Eigen::Index along = 0;
    way_out.cwiseAbs().maxCoeff(&along);
    Vec3 point = inside;
    point[along] = way_out[along] > 0 ? box.maximum[along] : box.minimum[along];
    return point;
  }
  const Vec3 above = inside - box.minimum;
  const Vec3 below = box.maximum - inside;
  Eigen::Index lowest = 0;
  Eigen::Index highest = 0;
  const bool is_low = above.minCoeff(&lowest) < below.minCoeff(&highest);
  const Eigen::Index axis = is_low ? lowest : highest;
  Vec3 point = inside;
  point[axis] = is_low ? box.minimum[axis] : box.maximum[axis];
  return point;
}

static Vec3 on_surface(const solids::Cylinder& cylinder, const Vec3& inside, const Vec3& way_out) {
  const double height = cylinder.at.axis.dot(inside - cylinder.at.origin);
  const Vec3 center = cylinder.at.at(height);
  const Vec3 outwards = inside - center;
  if (!way_out.isZero(0)) {
    const double along = cylinder.at.axis.dot(way_out);
    const Vec3 across = way_out - along * cylinder.at.axis;
    if (std::abs(along) > across.norm()) return cylinder.at.at(along > 0 ? cylinder.height : 0) + outwards;
    return center + across.normalized() * cylinder.radius;
  }
  const double radius = outwards.norm();
  const double to_face = std::min(height, cylinder.height - height);
  if (radius > 0 && cylinder.radius - radius <= to_face) return center + outwards * (cylinder.radius / radius);
  return cylinder.at.at(height <= cylinder.height - height ? 0 : cylinder.height) + outwards;
}

static Vec3 on_surface(const std::shared_ptr<const solids::Mesh>&, const Vec3& on_triangle, const Vec3&) {
  return on_triangle;
}

/// Where two bodies overlap, the point of the obstacle may be any point of both.
static solids::Clearance with_surface_point(const BodyShape& shape, solids::Clearance found) {
  if (found.upper < 0)
    found.on_obstacle =
        std::visit([&](const auto& obstacle) { return on_surface(obstacle, found.on_obstacle, found.way_out); }, shape);
  return found;
}

solids::Clearance distance_of(const BodyPair& pair, const Obstacle& obstacle, const solids::AxisPlacement& at,
                              double sufficient) {
  if (pair.core) return clearance(*pair.revolved, at, *pair.core, sufficient);
  return with_surface_point(obstacle.shape, with_solid(obstacle.shape, [&](const auto& solid) {
                              return clearance(*pair.revolved, at, solid, sufficient);
                            }));
}

solids::Clearance distance_of(const MovingPart& part, const Obstacle& obstacle, const solids::Placement& at,
                              double sufficient) {
  return with_surface_point(obstacle.shape, with_solid(obstacle.shape, [&](const auto& solid) {
                              return with_solid(part.body->shape, [&](const auto& moving) {
                                return clearance(moving, at, solid, sufficient);
                              });
                            }));
}

solids::Clearance deepest_of(const BodyPair& pair, const solids::AxisPlacement& at) {
  return solids::deepest(*pair.revolved, at, *pair.core);
}

double way_clearance_of(const BodyPair& pair, const Obstacle& obstacle, const solids::AxisPlacement& from,
                        const Vec3& way, double sufficient) {
  if (pair.core)
    return pair.core->faces() ? way_clearance(*pair.revolved, from, way, *pair.core->faces(), sufficient)
                              : solids::kExact;
  return with_solid(obstacle.shape,
                    [&](const auto& solid) { return way_clearance(*pair.revolved, from, way, solid, sufficient); });
}

}  // namespace isocnc::verification
