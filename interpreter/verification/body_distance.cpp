#include "interpreter/verification/body_distance.h"

namespace isocnc::verification {

solids::Clearance distance_to(const BodyShape& shape, const solids::RevolvedBody& body, const solids::AxisPlacement& at,
                              double sufficient) {
  return with_solid(shape, [&](const auto& obstacle) { return clearance(body, at, obstacle, sufficient); });
}

solids::Clearance distance_to(const BodyShape& shape, const BodyShape& body, const solids::Placement& at,
                              double sufficient) {
  return with_solid(shape, [&](const auto& obstacle) {
    return with_solid(body, [&](const auto& moving) { return clearance(moving, at, obstacle, sufficient); });
  });
}

}  // namespace isocnc::verification
