#pragma once

#include "analyzer/command_line.h"
#include "analyzer/formats/rendering.h"
#include "interpreter/system/exit_status.h"

namespace isocnc::analyzer {

/// Checks programs, and again those that others write, until the end is requested. Returns the status of the last
/// state.
system::ExitStatus watch(const LintCommandOptions& options, const formats::ReportStyle& style);

}  // namespace isocnc::analyzer
