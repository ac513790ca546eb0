#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "interpreter/comparison/alignment.h"
#include "interpreter/comparison/comparison.h"

namespace isocnc::comparison {

/// An operation, from one tool change to the next, that only one run has or that both do at another time.
struct OperationChange {
  BehaviorChange change;
  std::size_t action = 0;  ///< Index in OrderedRuns::a at which it stands, or stood.
};

/// Two runs with the same operations in the order of the first one.
struct OrderedRuns {
  RecordedRun a;
  RecordedRun b;
  std::vector<OperationChange> changes;  ///< Not empty.
};

/// Takes out the operations that one run has more than the other one, and puts those of the second run in the order of
/// the first one, so that what is left can be compared motion by motion. None where the order is the same already, and
/// where it is not clear which operations belong together: at least those before and after a change are the same.
std::optional<OrderedRuns> in_same_order(const RunPair& runs, const ComparisonOptions& options);

}  // namespace isocnc::comparison
