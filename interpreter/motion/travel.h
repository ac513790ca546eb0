#pragma once

#include <array>

#include "interpreter/geometry/range.h"
#include "interpreter/motion/stretch.h"

namespace isocnc::motion {

/// From where to where each joint goes on the way, the bulges of arcs and the swing of the head included; mm and
/// degrees.
std::array<geometry::Range, kAxisCount> joint_ranges(const Kinematics& kinematics, const Stretch& stretch);

}  // namespace isocnc::motion
