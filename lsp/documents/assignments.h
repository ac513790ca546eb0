#pragma once

#include <vector>

#include "lsp/documents/names.h"

namespace isocnc::lsp::documents {

/// The assignments whose value the register may have at this read, in the order of the program. Empty if no path leads
/// from an assignment to the read.
std::vector<Occurrence> assignments_reaching(const Snapshot& snapshot, const Occurrence& read);

}  // namespace isocnc::lsp::documents
