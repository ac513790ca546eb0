#pragma once

#include "interpreter/geometry/vectors.h"
#include "interpreter/solids/frustum.h"
#include "interpreter/stock/height_interval.h"

/// Where a vertical line meets convex bodies in any direction, in closed form. Lines are given by their x and y.
namespace isocnc::stock {

/// Of a frustum.
HeightInterval chord(const solids::Frustum& frustum, const solids::AxisPlacement& at, const geometry::Vec2& line);

/// Of a sphere that moves along a segment. Both ends may be the same.
HeightInterval capsule_chord(const geometry::Vec3& from, const geometry::Vec3& to, double radius,
                             const geometry::Vec2& line);

}  // namespace isocnc::stock
