#include "analyzer/revisions/revision_comparison.h"

#include <utility>

namespace isocnc::revisions {

RevisionComparison compare(const RevisionPair& pair, const CompareOptions& options) {
  RevisionComparison compared{.old_run = run_revision(pair.old_revision, options.run, options.together),
                              .new_run = run_revision(pair.new_revision, options.run, options.together),
                              .changes = {},
                              .findings = {}};
  compared.changes = comparison::compare(compared.old_run.recorded, compared.new_run.recorded, options.comparison);
  compared.findings = finding_changes(compared.old_run, compared.new_run, options.comparison.tolerance);
  return compared;
}

}  // namespace isocnc::revisions
