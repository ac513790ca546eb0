#pragma once

#include <algorithm>
#include <array>
#include <numeric>

#include "analyzer/check/report.h"

namespace isocnc::selection {

/// How often each code was found, and how much it weighed: not the same in every program.
class Tally {
 public:
  void add(const check::Report& report) {
    for (const check::LocatedFinding& located : report.findings)
      ++counts_[static_cast<std::size_t>(located.finding.id)][static_cast<std::size_t>(located.severity())];
  }
  std::size_t of(dialect::DiagnosticId id) const {
    const Counts& counts = counts_[static_cast<std::size_t>(id)];
    return std::accumulate(counts.begin(), counts.end(), std::size_t{0});
  }
  std::size_t of(dialect::Severity severity) const {
    std::size_t sum = 0;
    for (const Counts& counts : counts_) sum += counts[static_cast<std::size_t>(severity)];
    return sum;
  }
  /// The most that a code weighed where it was found.
  dialect::Severity heaviest(dialect::DiagnosticId id) const {
    const Counts& counts = counts_[static_cast<std::size_t>(id)];
    const auto* const first = std::find_if(counts.begin(), counts.end(), [](std::size_t count) { return count > 0; });
    return first == counts.end() ? dialect::definition(id).severity : dialect::Severity(first - counts.begin());
  }

 private:
  using Counts = std::array<std::size_t, 3>;  // By severity, the heaviest first.

  std::array<Counts, dialect::kDiagnosticCount> counts_{};
};

}  // namespace isocnc::selection
