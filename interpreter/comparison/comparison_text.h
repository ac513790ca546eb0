#pragma once

#include <span>
#include <string>
#include <string_view>

#include "interpreter/comparison/comparison.h"
#include "interpreter/dialect/diagnostic.h"

namespace isocnc::comparison {

/// The name of the kind in JSON: `moved`.
std::string_view name_of(ChangeKind kind);

/// What has changed, in words: `moved by up to 0.2 mm`.
std::string in_words(const BehaviorChange& change, dialect::Language language);

/// Two compared runs.
struct ComparedRuns {
  const RecordedRun& old_run;
  const RecordedRun& new_run;
  std::span<const BehaviorChange> changes;
};

/// The changes for people, grouped by tool in the order of the run, and the totals that differ. Ends with a line end.
std::string text_of(const ComparedRuns& runs, dialect::Language language);

/// The changes as one line of JSON (docs/isodiff.md), with its line end.
std::string json_of(const ComparedRuns& runs, dialect::Language language);

}  // namespace isocnc::comparison
