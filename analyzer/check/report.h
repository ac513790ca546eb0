#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "interpreter/dialect/diagnostic_id.h"
#include "interpreter/syntax/finding.h"

namespace isocnc::check {

/// A decision at an IF: which one, counted from the top of the file, and whether the jump was taken.
struct Decision {
  std::uint32_t jump = 0;
  bool taken = false;
  bool is_legible = true;  ///< Whether the condition can be read, so that it is known when the jump is taken.

  friend bool operator==(const Decision&, const Decision&) = default;
};

/// The decisions that lead to a place, the latest first.
using Decisions = std::vector<Decision>;

/// A finding on its line.
struct LocatedFinding {
  static constexpr std::int32_t kEveryPath = -1;

  std::size_t line = 0;  ///< The line, from 0.
  syntax::Finding finding;
  std::int32_t path = kEveryPath;             ///< An index into Report::paths.
  std::int32_t mistake = -1;                  ///< Findings with the same number have the same cause (D66); -1: alone.
  std::int32_t repetitions = -1;              ///< An index into Report::repetitions; -1: none.
  std::optional<dialect::Severity> selected;  ///< The severity that a selection has set.
  bool is_of_run = false;                     ///< Whether only a run on the machine shows it.
  std::optional<std::size_t> last_line;       ///< Of a run's finding: where it ends, if on another line; from 0.
  std::optional<std::size_t> worst_line;      ///< Of a run's finding: as RunFinding::worst_line.
  std::optional<std::size_t> shaped_by;       ///< Of a run's finding: as RunFinding::shaped_by.

  dialect::Severity severity() const {
    return selected.value_or(finding.severity.value_or(dialect::definition(finding.id).severity));
  }

  friend bool operator==(const LocatedFinding&, const LocatedFinding&) = default;
};

/// One step of a path as users read it.
struct PathStep {
  std::size_t line = 0;  ///< The line of the IF, from 0.
  bool taken = false;

  friend bool operator==(const PathStep&, const PathStep&) = default;
};

/// A line below a finding that shows the same mistake again (D66).
struct Repetition {
  std::size_t line = 0;  ///< The line, from 0.
  dialect::DiagnosticId id = dialect::kNoDiagnostic;
  syntax::Span span;

  syntax::Finding finding() const { return {.id = id, .span = span}; }

  friend bool operator==(const Repetition&, const Repetition&) = default;
};

/// All findings of a program, sorted by line and column.
struct Report {
  std::vector<LocatedFinding> findings;
  std::vector<std::vector<PathStep>> paths;          ///< The steps of each path, in the order of the program.
  std::vector<std::vector<Repetition>> repetitions;  ///< What folded() has taken out of `findings`, by line.

  std::span<const Repetition> repetitions_of(const LocatedFinding& located) const {
    if (located.repetitions < 0) return {};
    return repetitions[static_cast<std::size_t>(located.repetitions)];
  }

  friend bool operator==(const Report&, const Report&) = default;
};

}  // namespace isocnc::check
