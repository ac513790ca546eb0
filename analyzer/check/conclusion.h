#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "analyzer/check/outcome.h"

namespace isocnc::check {

/// The outcome of some lines, which stand from this one on.
struct PlacedOutcome {
  const Outcome* outcome = nullptr;
  std::uint64_t first_line = 0;
};

/// The first findings of a program, and how many follow them.
struct FirstFindings {
  Report report;
  std::size_t left_out = 0;  ///< Findings that count and are not in the report.
};

/// What an excerpt holds.
struct FirstFindingsOptions {
  std::size_t max = static_cast<std::size_t>(-1);  ///< Findings that count; a few more where they come together.
  std::function<bool(dialect::DiagnosticId)> counts = {};  ///< Which findings count; without it all do.
};

/// Puts together what was found: sorts, adds what only the whole program shows (E006, ISO045), and keeps the first of
/// the findings that are reported once per program (D44). `text_of_line` gives a line's text.
Report conclude(Outcome outcome, const Frontier& end, const JumpMap& jumps,
                const std::function<std::string_view(std::uint64_t)>& text_of_line);
/// The same of several outcomes, in the order of the program, and of the `counts` of them all. Those that have nothing
/// but `has_text` may be left out, except the last of these.
FirstFindings conclude(const std::vector<PlacedOutcome>& outcomes, const FindingCounts& counts, const Frontier& end,
                       const JumpMap& jumps, const std::function<std::string_view(std::uint64_t)>& text_of_line,
                       const FirstFindingsOptions& options = {});

/// Whether each jump on a feasible path leads to one of the labels seen.
bool all_jumps_resolve(const Outcome& outcome, const JumpMap& jumps);

}  // namespace isocnc::check
