#include "interpreter/verification/scene.h"

namespace isocnc::verification {

solids::BoundingBox bounds(const BodyShape& shape) {
  if (const auto* const mesh = std::get_if<std::shared_ptr<const solids::Mesh>>(&shape)) return (*mesh)->bounds();
  if (const auto* const cylinder = std::get_if<solids::Cylinder>(&shape)) return cylinder->bounds();
  return std::get<solids::Cuboid>(shape).bounds();
}

}  // namespace isocnc::verification
