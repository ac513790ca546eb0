#pragma once

#include "interpreter/dialect/lint_thresholds.h"
#include "interpreter/execution/setup.h"

namespace isocnc::rules {

/// What a check needs to know.
struct CheckSetup {
  execution::Setup machine;
  dialect::LintThresholds thresholds;
  /// Whether lint rules check every motion, plain ones included.
  bool every_motion = false;
};

}  // namespace isocnc::rules
