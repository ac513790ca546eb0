#pragma once

#include <string_view>

#include "interpreter/running/compensation.h"
#include "interpreter/running/runner.h"
#include "interpreter/running/timing.h"

namespace isocnc::running {

/// Runs a program on the machine, with cutter compensation, and tells what happens when.
RunResult run_timed(std::string_view text, const RunOptions& options, const TimedMachine& machine,
                    Timing::Listeners listeners);

}  // namespace isocnc::running
