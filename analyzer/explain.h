#pragma once

#include <string>

#include "interpreter/dialect/diagnostic_id.h"

namespace isocnc::analyzer {

/// The full description of a code, for the terminal: `isolint --explain ISO031`.
std::string explain(dialect::DiagnosticId id, dialect::Language language);
/// One line for each code: `isolint --list-rules`.
std::string list_rules(dialect::Language language);
/// The page of all codes: docs/rules.md, which has the texts in both languages, and docs/it/codici.md.
std::string rules_page(dialect::Language language);
}  // namespace isocnc::analyzer
