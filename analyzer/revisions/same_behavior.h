#pragma once

#include <optional>
#include <string>

#include "analyzer/revisions/revision_comparison.h"

namespace isocnc::revisions {

/// Why it is not certain that the machine does the same by another text of a program: because it does not, because not
/// all paths could be compared, or because an error stops it before its end. In words without a line end; none if it
/// does the same, on every path that the IFs lead along.
std::optional<std::string> why_not_same(const RevisionPair& pair, const CompareOptions& options,
                                        dialect::Language language);

}  // namespace isocnc::revisions
