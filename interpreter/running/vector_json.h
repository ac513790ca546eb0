#pragma once

#include <nlohmann/json.hpp>

#include "interpreter/geometry/vectors.h"

namespace isocnc::running {

/// `[x, y, z]`.
inline nlohmann::ordered_json array(const geometry::Vec3& v) {
  return nlohmann::ordered_json::array({v.x(), v.y(), v.z()});
}

/// `[x, y, z, b, c]`.
inline nlohmann::ordered_json array(const geometry::Pose& p) {
  return nlohmann::ordered_json::array({p.tip.x(), p.tip.y(), p.tip.z(), p.b, p.c});
}

}  // namespace isocnc::running
