#pragma once

#include <memory>
#include <utility>
#include <variant>

#include "interpreter/solids/clearance.h"
#include "interpreter/verification/body_pairs.h"

namespace isocnc::verification {

/// Calls `use` with the solid that a shape is, and returns what it returns.
template <class Use>
auto with_solid(const BodyShape& shape, Use&& use) {
  if (const auto* const box = std::get_if<solids::Cuboid>(&shape)) return use(*box);
  if (const auto* const cylinder = std::get_if<solids::Cylinder>(&shape)) return use(*cylinder);
  return use(*std::get<std::shared_ptr<const solids::Mesh>>(shape));
}

// Distances between the bodies of a pair, as solids::clearance() has them, with the moving part at `at` in the frame of
// the obstacle's shape. The point of the obstacle is one of its surface.

/// Of a part of the tool or the nose.
solids::Clearance distance_of(const BodyPair& pair, const Obstacle& obstacle, const solids::AxisPlacement& at,
                              double sufficient);
/// Of another part.
solids::Clearance distance_of(const MovingPart& part, const Obstacle& obstacle, const solids::Placement& at,
                              double sufficient);

/// How deep a part of the tool is in the core of an obstacle (BodyPair::core), as solids::deepest().
solids::Clearance deepest_of(const BodyPair& pair, const solids::AxisPlacement& at);

/// A lower bound of the distance on a straight way of a part of the tool or the nose, as solids::way_clearance().
double way_clearance_of(const BodyPair& pair, const Obstacle& obstacle, const solids::AxisPlacement& from,
                        const geometry::Vec3& way, double sufficient);

}  // namespace isocnc::verification
