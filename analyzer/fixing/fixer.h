#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "analyzer/check/report.h"
#include "analyzer/selection/selection.h"
#include "interpreter/execution/setup.h"

namespace isocnc::fixing {

/// What is to be fixed.
struct FixOptions {
  const selection::Selection& selection;
  const execution::Setup& setup;
  bool unsafe = false;  ///< Unsafe fixes, too.
  int jobs = 1;
  /// Of what is found and selected in a text, what is somebody's concern; the rest is not fixed. None: all is.
  std::function<check::Report(check::Report, std::string_view)> finding_filter = {};
};

/// A text with its fixes.
struct FixedText {
  static constexpr std::uint64_t kNew = UINT64_MAX;

  std::string text;
  check::Report report;                ///< What remains.
  std::size_t fixed = 0;               ///< Findings that have been mended.
  std::size_t filtered_out = 0;        ///< What remains and is nobody's concern.
  std::vector<std::uint64_t> origins;  ///< Of each line: the line of the original text that it was, or kNew.
};

/// Applies the fixes of what is found, round by round, until nothing changes. Of two that overlap the first in the
/// program comes first. A fix counts only when its finding is gone and no code is found more often than before,
/// whether it is selected or not; else it is undone. All that shows a habit of the author is rewritten at once, and
/// may bring to light what was wrong before (reads_better). Fixing the result again changes nothing, unless it was so
/// long, with so many fixes undone, that there was no time for all of them.
FixedText fix_text(std::string_view text, const FixOptions& options);

}  // namespace isocnc::fixing
