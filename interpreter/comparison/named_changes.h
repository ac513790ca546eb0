#pragma once

#include "interpreter/comparison/change_list.h"
#include "interpreter/comparison/motion_steps.h"

namespace isocnc::comparison {

/// Names what differs in a part: an end before that of the other run, an IF that one of them takes, another order, or
/// else its motions and what the machine does between them.
void name_part(ChangeList& changes, const DifferentPart& part);

/// Names how one of the motions that close a part goes otherwise than the other one, if it does.
void name_closing_way(ChangeList& changes, const DifferentPart& part);

/// Names what differs in the motions of a part: where they lead, their paths and their feeds.
void name_motions(ChangeList& changes, const MotionBlock& block, const DifferentPart& part);

}  // namespace isocnc::comparison
