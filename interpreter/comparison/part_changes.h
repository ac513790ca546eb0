#pragma once

#include "interpreter/comparison/change_list.h"
#include "interpreter/comparison/motion_steps.h"

namespace isocnc::comparison {

/// Names what differs in a part: an end before that of the other run, an IF that one of them takes, another order, or
/// else its motions (motion_changes.h) and what the machine does between them.
void name_part(ChangeList& changes, const DifferentPart& part);

}  // namespace isocnc::comparison
