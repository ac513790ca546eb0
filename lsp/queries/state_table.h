#pragma once

#include <string>
#include <vector>

#include "interpreter/dialect/diagnostic.h"
#include "lsp/queries/line_run.h"

namespace isocnc::queries {

/// The states before and after a line as a table for people. A row in which they differ starts with `*`; what is not
/// known, or differs from path to path, is `?`. Lengths in mm, angles in degrees, feeds in mm/min.
std::string state_table(const LineRun& run, dialect::Language language);

/// The same from the states of several paths, of which there is one at least. States that paths join in say nothing
/// certain of tool, spindle and feed (execution::join).
std::string state_table(const std::vector<LineRun>& runs, dialect::Language language);

}  // namespace isocnc::queries
