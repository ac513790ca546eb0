#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "analyzer/check/report.h"
#include "analyzer/rules/check_setup.h"
#include "analyzer/selection/shown_report.h"

namespace isocnc::fixing {

/// What to fix, and how.
struct FixOptions {
  const selection::Selection& selection;
  const rules::CheckSetup& setup;
  bool unsafe = false;  ///< Includes unsafe fixes.
  int jobs = 1;
  /// Filter of the selected findings, for example by a baseline. Only those it returns are fixed; without a filter,
  /// all.
  selection::FindingFilter finding_filter = {};
};

/// The result of fixing a text.
struct FixedText {
  static constexpr std::size_t kNew = SIZE_MAX;

  std::string text;
  check::Report report;              ///< The remaining findings, folded (D66).
  std::size_t fixed = 0;             ///< The number of findings fixed, counted likewise; not 0 if the text changed.
  std::size_t filtered_out = 0;      ///< The number of remaining findings that the filter dropped.
  std::vector<std::size_t> origins;  ///< For each line, its line in the original text, or kNew.
};

/// Applies the fixes of the findings, round by round, until nothing changes. Of two fixes that overlap, the first in
/// the program is applied first. A fix is kept only if it removes its finding and no code is found more often than
/// before, whether selected or not; otherwise it is undone. All instances of a habit are rewritten together, which may
/// reveal findings that the habit hid (reads_better). Fixing the result again changes nothing, unless the work budget
/// ran out because the text was long and many fixes were undone.
FixedText fix_text(std::string_view text, const FixOptions& options);

}  // namespace isocnc::fixing
