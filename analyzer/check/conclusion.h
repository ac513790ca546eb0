#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "analyzer/check/outcome.h"

namespace isocnc::check {

/// The outcome of some lines, and the number of the first of them.
struct PlacedOutcome {
  const Outcome* outcome = nullptr;
  std::size_t first_line = 0;
};

/// The first findings of a program, and the number of those left out.
struct FirstFindings {
  Report report;
  std::size_t left_out = 0;  ///< Findings that count but are not in the report.
};

/// Which findings an excerpt holds. Findings of one outcome come together, so there may be more than `max`.
struct FirstFindingsOptions {
  std::size_t max = static_cast<std::size_t>(-1);  ///< The maximum of findings that count.
  /// The severity of each finding that counts, and nothing for the others; if empty, all count, with that of the table.
  std::function<std::optional<dialect::Severity>(dialect::DiagnosticId)> severity = {};
  bool folds = false;  ///< Whether the findings that count are folded (D66).
};

/// Makes the report: sorts the findings, numbers their mistakes (D66), adds those that need the whole program (E006,
/// ISO045), and keeps the first of the findings that are reported once per program (D44). `text_of_line` gives a line's
/// text.
Report conclude(Outcome outcome, const Frontier& end, const JumpMap& jumps,
                const std::function<std::string_view(std::size_t)>& text_of_line);
/// The same for several outcomes in program order, with the summed `counts`. Outcomes with `has_text` alone may be
/// omitted, except the last of them.
FirstFindings conclude(const std::vector<PlacedOutcome>& outcomes, const FindingCounts& counts, const Frontier& end,
                       const JumpMap& jumps, const std::function<std::string_view(std::size_t)>& text_of_line,
                       const FirstFindingsOptions& options = {});

/// Whether each jump on a feasible path leads to one of the labels seen.
bool all_jumps_resolve(const Outcome& outcome, const JumpMap& jumps);

}  // namespace isocnc::check
