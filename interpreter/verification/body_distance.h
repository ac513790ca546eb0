#pragma once

#include <memory>
#include <utility>
#include <variant>

#include "interpreter/solids/clearance.h"
#include "interpreter/verification/scene.h"

namespace isocnc::verification {

/// Calls `use` with the solid that a shape is, and returns what it returns.
template <class Use>
auto with_solid(const BodyShape& shape, Use&& use) {
  if (const auto* const box = std::get_if<solids::Cuboid>(&shape)) return use(*box);
  if (const auto* const cylinder = std::get_if<solids::Cylinder>(&shape)) return use(*cylinder);
  return use(*std::get<std::shared_ptr<const solids::Mesh>>(shape));
}

// Distances to a shape, of a body that is at `at` in the shape's frame; `sufficient` as in solids::clearance(). The
// point of the obstacle is one of its surface.

solids::Clearance distance_to(const BodyShape& shape, const solids::RevolvedBody& body, const solids::AxisPlacement& at,
                              double sufficient);
solids::Clearance distance_to(const BodyShape& shape, const BodyShape& body, const solids::Placement& at,
                              double sufficient);

}  // namespace isocnc::verification
