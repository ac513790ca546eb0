#pragma once

#include <vector>

#include "lsp/documents/names.h"

namespace isocnc::lsp::documents {

/// The assignments whose value may be in the register when it is read there, in the order of the program. None where
/// no path leads from one to it.
std::vector<Occurrence> assignments_reaching(const Snapshot& snapshot, const Occurrence& read);

}  // namespace isocnc::lsp::documents
