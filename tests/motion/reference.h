#pragma once

#include <vector>

#include "interpreter/kinematics/machine.h"
#include "interpreter/kinematics/move.h"
#include "interpreter/motion/stretch.h"
#include "tests/motion/programs.h"

namespace isocnc::motion {

/// The shortest time, in seconds, over the same path from rest to rest, by a slow optimization on a fine grid that
/// shares no code with the planner: at every grid point the axes keep their limits with the acceleration of the
/// intervals on both sides, and with none; corners are taken at a constant rate. Bounds hold at the points alone, so
/// the result is a little optimistic; `steps` for each phase of each stretch.
double reference_time(const kinematics::Machine& machine, const std::vector<kinematics::Move>& moves,
                      const std::vector<Stretch>& stretches, int steps);

}  // namespace isocnc::motion
