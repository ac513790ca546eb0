#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "interpreter/comparison/motion_steps.h"

namespace isocnc::comparison {

/// What becomes of what the machine does between its motions: of one action of each run, or of one alone. Dwells that
/// follow each other may count together.
struct EffectStep {
  std::optional<std::size_t> a;  ///< Index of the action.
  std::optional<std::size_t> b;
  std::size_t a_count = 1;  ///< How many dwells from `a` on count together.
  std::size_t b_count = 1;
  bool is_same = false;
  double later = 0;  ///< By how much farther on the way the second run does it, mm; negative for earlier.
};

/// The steps through the actions of a part that are no motions, which change the least.
std::vector<EffectStep> effect_steps(const RunPair& runs, const ActionRanges& part, const MotionBlock& motions);

}  // namespace isocnc::comparison
