#pragma once

#include <vector>

#include "lsp/queries/names.h"

namespace isocnc::queries {

/// The assignments whose value the register may have at this read, in the order of the program. Empty if no path leads
/// from an assignment to the read.
std::vector<Occurrence> assignments_reaching(const documents::Snapshot& snapshot, const Occurrence& read);

}  // namespace isocnc::queries
