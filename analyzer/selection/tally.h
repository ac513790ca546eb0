#pragma once

#include <algorithm>
#include <array>
#include <numeric>

#include "analyzer/check/report.h"

namespace isocnc::selection {

/// The number of findings of each code and severity; a code's severity may differ between programs.
class Tally {
 public:
  void add(const check::Report& report) {
    for (const check::LocatedFinding& located : report.findings)
      ++counts_[static_cast<std::size_t>(located.finding.id)][static_cast<std::size_t>(located.severity())];
  }
  std::size_t of(dialect::DiagnosticId id) const {
    const SeverityCounts& counts = counts_[static_cast<std::size_t>(id)];
    return std::accumulate(counts.begin(), counts.end(), std::size_t{0});
  }
  std::size_t of(dialect::Severity severity) const {
    std::size_t sum = 0;
    for (const SeverityCounts& counts : counts_) sum += counts[static_cast<std::size_t>(severity)];
    return sum;
  }
  /// The highest severity with which a code was found; its default if it was not found.
  dialect::Severity heaviest(dialect::DiagnosticId id) const {
    const SeverityCounts& counts = counts_[static_cast<std::size_t>(id)];
    const auto* const first = std::find_if(counts.begin(), counts.end(), [](std::size_t count) { return count > 0; });
    return first == counts.end() ? dialect::definition(id).severity : dialect::Severity(first - counts.begin());
  }

 private:
  using SeverityCounts = std::array<std::size_t, 3>;  // The counts by severity, the highest first.

  std::array<SeverityCounts, dialect::kDiagnosticCount> counts_{};
};

}  // namespace isocnc::selection
