#pragma once

#include <vector>

#include "interpreter/motion/planner.h"
#include "interpreter/motion/stretch.h"
#include "tests/kinematics/moves.h"

namespace isocnc::motion {

using kinematics::arc_xy;
using kinematics::distance;
using kinematics::duration;
using kinematics::kRapid;
using kinematics::line;
using kinematics::programmed;
using kinematics::random_moves;
using kinematics::speed;
using kinematics::uniform_machine;
using kinematics::with_jerk;

/// All that a planner makes of the moves, which end at rest.
std::vector<Stretch> plan(const kinematics::Machine& machine, const std::vector<kinematics::Move>& moves);

/// When the last stretch ends.
double cycle_time(const std::vector<Stretch>& stretches);

}  // namespace isocnc::motion
