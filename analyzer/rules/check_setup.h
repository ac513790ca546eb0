#pragma once

#include <memory>

#include "analyzer/rules/house_rules.h"
#include "interpreter/dialect/lint_thresholds.h"
#include "interpreter/execution/setup.h"

namespace isocnc::rules {

/// What a check needs to know.
struct CheckSetup {
  execution::Setup machine;
  dialect::LintThresholds thresholds;
  /// Whether lint rules check every motion, plain ones included.
  bool every_motion = false;
  /// The rules of the shop; null if there are none, or none is shown.
  std::shared_ptr<const HouseRules> house_rules = nullptr;
};

}  // namespace isocnc::rules
