#pragma once

#include <algorithm>
#include <concepts>
#include <limits>

#include "interpreter/solids/mesh.h"
#include "interpreter/solids/obstacle.h"
#include "interpreter/solids/revolved_body.h"

namespace isocnc::solids {

/// Subtracted from every lower bound for the rounding of doubles, mm. It suffices for coordinates up to kMaxCoordinate.
inline constexpr double kRounding = 1e-6;
inline constexpr double kMaxCoordinate = 1e6;  ///< mm

/// What is known of the signed distance of a body and an obstacle, mm: lower <= distance <= upper. Both agree within
/// 2 kRounding, or 10 kRounding between faces that are parallel but for less than 1e-4 radians, except where the caller
/// asked for less by `sufficient`.
///
/// The distance is that of the nearest two points where body and obstacle are apart. Where they overlap, it is
/// negative, and both bounds are -depth(). From a convex obstacle (box, cylinder, convex mesh), the depth is the length
/// of a translation that surely frees all of the body, nearly always the shortest one. In another mesh it is that of
/// the deepest triangle and piece of the body or, if the mesh is closed and the body one of revolution, of the deepest
/// of some points of the body: the body must move by about the depth or more to be free. The depth of two meshes of
/// which one is not convex is that of their deepest pair of triangles, which says little more than that they overlap.
/// Where a closed mesh encloses the whole body, or one of the surfaces of another mesh, and the surfaces are apart, the
/// depth is the distance of the surfaces.
struct Clearance {
  double lower = std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  geometry::Vec3 on_body = geometry::Vec3::Zero();      ///< The point of the body that `upper` belongs to.
  geometry::Vec3 on_obstacle = geometry::Vec3::Zero();  ///< The point of the obstacle.
  /// Where a body of revolution overlaps a convex obstacle: the way out, of length 1; else 0.
  geometry::Vec3 way_out = geometry::Vec3::Zero();

  double depth() const { return std::max(0.0, -upper); }
};

inline constexpr double kExact = std::numeric_limits<double>::infinity();

/// Bounds on the distance of a body from an obstacle. The search ends early once the lower bound reaches `sufficient`,
/// mm; `upper` may then be infinite. Where the body is that far away, this costs a few nanoseconds.
///
/// The lower bound holds by a separating plane for every pair of convex parts (separation.h), and by the distances of
/// spheres and boxes around the rest. A placement that is not finite gives a lower bound of minus infinity.
Clearance clearance(const RevolvedBody& body, const AxisPlacement& at, const Cuboid& obstacle,
                    double sufficient = kExact);
Clearance clearance(const RevolvedBody& body, const AxisPlacement& at, const Cylinder& obstacle,
                    double sufficient = kExact);
Clearance clearance(const RevolvedBody& body, const AxisPlacement& at, const Mesh& obstacle,
                    double sufficient = kExact);

/// What obstacles and bodies of the machine are made of.
template <class Shape>
concept Solid = std::same_as<Shape, Cuboid> || std::same_as<Shape, Cylinder> || std::same_as<Shape, Mesh>;

/// Bounds on the distance of a solid, at a placement in the frame of the obstacle, from the obstacle, with the same
/// promises. Both points are in the frame of the obstacle.
template <Solid Moving, Solid Obstacle>
Clearance clearance(const Moving& moving, const Placement& at, const Obstacle& obstacle, double sufficient = kExact);

/// A lower bound on the distance, from an obstacle, of all that a body covers on a straight way from `from`, mm; 0 or
/// less where it meets the obstacle's surface. It may be less than the distance by 2 kRounding, or more once it has
/// reached `sufficient`. What a closed mesh encloses from the start does not meet its surface.
template <Solid Obstacle>
double way_clearance(const RevolvedBody& body, const AxisPlacement& from, const geometry::Vec3& way,
                     const Obstacle& obstacle, double sufficient);

}  // namespace isocnc::solids
