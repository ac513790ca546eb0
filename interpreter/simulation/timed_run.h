#pragma once

#include <string_view>

#include "interpreter/running/runner.h"
#include "interpreter/simulation/compensation.h"
#include "interpreter/timing/timing.h"

namespace isocnc::simulation {

/// Runs a program on the machine, with cutter compensation, and reports the events with their times.
running::RunResult run_timed(std::string_view text, const running::RunOptions& options,
                             const timing::TimedMachine& machine, timing::TimingListeners listeners);

}  // namespace isocnc::simulation
