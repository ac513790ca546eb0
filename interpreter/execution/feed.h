#pragma once

#include "interpreter/execution/state.h"

namespace isocnc::execution {

/// Puts an F in force, as a line with a feed move does (I.3.7, D43): mm/min or inches/min, degrees/min where only B and
/// C turn, 1/min under G93. A number that is not positive leaves the feed unchanged.
void take_feed(double number, State& state);

/// Puts an S in force, in revolutions per minute (I.4.2). A number that is not positive leaves the speed unchanged.
void take_spindle_speed(double number, State& state);

}  // namespace isocnc::execution
