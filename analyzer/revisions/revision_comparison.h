#pragma once

#include <vector>

#include "analyzer/revisions/finding_changes.h"
#include "interpreter/comparison/comparison.h"
#include "interpreter/comparison/comparison_text.h"

namespace isocnc::revisions {

struct RevisionPair {
  const Revision& old_revision;
  const Revision& new_revision;
};

/// How two revisions are run and compared.
struct CompareOptions {
  running::RunOptions run;  ///< With the VGPL and the registers of both.
  comparison::ComparisonOptions comparison;
  verification::WorkTogether together = {};  ///< For scenes; without it, on the caller's thread alone.
};

/// Two runs, and what differs.
struct RevisionComparison {
  RevisionRun old_run;
  RevisionRun new_run;
  std::vector<comparison::BehaviorChange> changes;
  /// These make no difference by themselves: what the machine does is the same.
  std::vector<FindingChange> findings;

  bool is_same() const { return changes.empty(); }
  comparison::ComparedRuns runs() const { return {old_run.recorded, new_run.recorded, changes}; }
};

RevisionComparison compare(const RevisionPair& pair, const CompareOptions& options);

}  // namespace isocnc::revisions
