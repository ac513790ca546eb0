#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "interpreter/dialect/diagnostic_id.h"
#include "interpreter/syntax/finding.h"

namespace isocnc::check {

/// A decision at an IF: which one, counted from the top of the file, and whether the jump was taken.
struct Decision {
  std::uint32_t jump = 0;
  bool taken = false;

  friend bool operator==(const Decision&, const Decision&) = default;
};

/// The decisions that lead somewhere, the latest first.
using Path = std::vector<Decision>;

/// A finding on its line.
struct LocatedFinding {
  static constexpr std::int32_t kEveryPath = -1;

  std::uint64_t line = 0;  ///< From 0.
  syntax::Finding finding;
  std::int32_t path = kEveryPath;             ///< Of Report::paths.
  std::optional<dialect::Severity> selected;  ///< What a selection has made of its severity.

  dialect::Severity severity() const { return selected.value_or(dialect::definition(finding.id).severity); }

  friend bool operator==(const LocatedFinding&, const LocatedFinding&) = default;
};

/// One step of a path as users read it.
struct PathStep {
  std::uint64_t line = 0;  ///< Of the IF, from 0.
  bool taken = false;

  friend bool operator==(const PathStep&, const PathStep&) = default;
};

/// Everything that is wrong with a program, sorted by line and column.
struct Report {
  std::vector<LocatedFinding> findings;
  std::vector<std::vector<PathStep>> paths;  ///< In the order of the program.

  friend bool operator==(const Report&, const Report&) = default;
};

}  // namespace isocnc::check
