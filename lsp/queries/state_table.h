#pragma once

#include <string>
#include <vector>

#include "interpreter/dialect/diagnostic.h"
#include "lsp/queries/line_run.h"

namespace isocnc::queries {

/// The states before and after a line as a table for people, from all states in which paths reach it, of which there is
/// one at least. A row in which they differ starts with `*`; what is not known, or differs from path to path, is `?`.
/// Lengths in mm, angles in degrees, feeds in mm/min.
std::string state_table(const std::vector<LineRun>& runs, dialect::Language language);

}  // namespace isocnc::queries
