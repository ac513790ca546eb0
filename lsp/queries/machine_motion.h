#pragma once

#include <cstddef>
#include <optional>

#include "interpreter/kinematics/move.h"
#include "lsp/queries/line_run.h"

namespace isocnc::queries {

/// The motion of a line as the machine makes it. It starts where the tip is, which after a change to a tool of another
/// length is not the programmed position (I.3.4, D33). `run` is one of the runs of the line and has a motion.
///
/// Nothing where the tool is beside the program: under G41 and G42, and after G40 until a motion has led it back.
/// Nothing either where the lines above do not show where the tip is, and where it is not known where the machine is:
/// not after a tool whose length is not known (timing::TipPosition).
std::optional<kinematics::Move> machine_motion(const documents::Snapshot& snapshot, std::size_t line,
                                               const LineRun& run);

/// The tool that is mounted in a state after so many lines, all 0 for the empty spindle; nothing if paths have
/// different tools.
std::optional<execution::ToolCode> mounted_tool(const documents::Snapshot& snapshot, std::size_t lines,
                                                const execution::State& state);

}  // namespace isocnc::queries
