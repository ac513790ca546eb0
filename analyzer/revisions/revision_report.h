#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "analyzer/revisions/revision_comparison.h"

namespace isocnc::revisions {

/// What differs, for people: the changes of behavior by tool and operation, the totals, the findings that are new or
/// gone, and the count. Ends with a line end.
std::string text_of(const RevisionComparison& compared, const comparison::TextStyle& style);

/// Which values that were not compared lead the programs along other paths: a line for the first jump of VGPL and of
/// registers in each; empty if all lead along these paths.
std::string other_paths_text(const RevisionComparison& compared, dialect::Language language);

/// As JSON (docs/isodiff.md).
nlohmann::ordered_json to_json(const RevisionComparison& compared, dialect::Language language);
/// As one line, with its line end, and with the jumps of other_paths_text().
std::string json_of(const RevisionComparison& compared, dialect::Language language);

}  // namespace isocnc::revisions
