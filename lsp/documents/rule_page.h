#pragma once

#include <string>

#include "interpreter/dialect/diagnostic_id.h"

namespace isocnc::documents {

/// The address of a rule's documentation page, as in isolint. A relative address is resolved to a file of the
/// installation or the build, so that an editor can open it.
std::string rule_page(dialect::DiagnosticId id);

}  // namespace isocnc::documents
