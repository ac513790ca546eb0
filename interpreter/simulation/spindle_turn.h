#pragma once

#include "interpreter/simulation/timing.h"

namespace isocnc::simulation {

/// The spindle after an M03, M04 or M05 with the last S before it; an S alone waits for the next M03 or M04 (I.4.2).
Timing::SpindleMotion spindle_after(int function, double speed);

/// The spindle after any event: a tool change stops it, and most events leave it as it is.
Timing::SpindleMotion spindle_after(const running::Event& event, const Timing::SpindleMotion& before, double speed);

}  // namespace isocnc::simulation
