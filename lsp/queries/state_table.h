#pragma once

#include <string>

#include "interpreter/dialect/diagnostic.h"
#include "lsp/queries/line_run.h"

namespace isocnc::queries {

/// The states before and after a line as a table for people. A row in which they differ starts with `*`; what is not
/// known is `?`. Lengths in mm, angles in degrees, feeds in mm/min.
std::string state_table(const LineRun& run, dialect::Language language);

}  // namespace isocnc::queries
