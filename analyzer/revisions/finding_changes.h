#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "analyzer/revisions/revision_run.h"

namespace isocnc::revisions {

enum class FindingChangeKind : std::uint8_t {
  New,
  Gone,
  Changed,  ///< The same mistake in another measure: deeper, farther, faster.
};

/// A finding that the runs of two revisions do not share.
struct FindingChange {
  FindingChangeKind kind = FindingChangeKind::New;
  std::optional<std::size_t> old_finding;  ///< Its index in the report of each run that has it.
  std::optional<std::size_t> new_finding;
};

/// Compares what two runs have found, in the order of the new program, and what is gone before what comes after it.
/// Findings are the same if they say the same of actions of the machine that belong together: whatever the lines are
/// called, and whenever it happens.
std::vector<FindingChange> finding_changes(const RevisionRun& old_run, const RevisionRun& new_run, double tolerance);

}  // namespace isocnc::revisions
