#pragma once

#include <vector>

#include "interpreter/kinematics/machine.h"
#include "interpreter/kinematics/move.h"
#include "interpreter/motion/stretch.h"

namespace isocnc::motion {

/// A short time, in seconds, over the same path from rest to rest on a machine whose jerk is limited, by a slow ascent
/// on a grid of `nodes` places that shares no code with the planner: it begins far slower than the planner, and raises
/// the speed by bumps of all widths anywhere, as long as speeds, accelerations and jerks of all joints at the places,
/// by differences, are within their limits. So it is no proof of the optimum, but what is left when nothing can be
/// gained any more by going faster somewhere. All moves have the same feed; none ends in a stop but the last.
double jerk_limited_reference_time(const kinematics::Machine& machine, double feed,
                                   const std::vector<Stretch>& stretches, int nodes);

}  // namespace isocnc::motion
