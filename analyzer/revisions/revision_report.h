#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "analyzer/revisions/revision_comparison.h"

namespace isocnc::revisions {

/// What differs, for people: the changes of behavior by tool and operation, the totals, the findings that are new or
/// gone, and the count. Ends with a line end.
std::string text_of(const RevisionComparison& compared, const comparison::TextStyle& style);

/// As JSON (docs/isodiff.md).
nlohmann::ordered_json to_json(const RevisionComparison& compared, dialect::Language language);
/// As one line, with its line end.
std::string json_of(const RevisionComparison& compared, dialect::Language language);

}  // namespace isocnc::revisions
