#pragma once

#include "interpreter/simulation/timing.h"

namespace isocnc::simulation {

/// What an M03, M04 or M05 brings about, with the last S before it: an S alone waits for the next M03 or M04 (I.4.2).
Timing::Spindle spindle_after(int function, double speed);

/// The same after any event: a tool change stops the spindle, and most events leave it as it is.
Timing::Spindle spindle_after(const running::Event& event, const Timing::Spindle& before, double speed);

}  // namespace isocnc::simulation
