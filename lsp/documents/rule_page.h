#pragma once

#include <string>

#include "interpreter/dialect/diagnostic_id.h"

namespace isocnc::lsp::documents {

/// The page of a rule, as isolint names it. A relative one is looked for where the program has been installed, or
/// built, so that an editor can open it.
std::string rule_page(dialect::DiagnosticId id);

}  // namespace isocnc::lsp::documents
