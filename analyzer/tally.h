#pragma once

#include <array>

#include "analyzer/selection.h"

namespace isocnc::analyzer {

/// How often each code was found.
class Tally {
 public:
  void add(const Report& report) {
    for (const LocatedFinding& located : report.findings) ++counts_[static_cast<std::size_t>(located.finding.id)];
  }
  std::size_t of(dialect::DiagnosticId id) const { return counts_[static_cast<std::size_t>(id)]; }
  /// Findings that weigh so much by this selection.
  std::size_t of(dialect::Severity severity, const Selection& selection) const {
    std::size_t sum = 0;
    for (std::size_t i = 0; i < counts_.size(); ++i)
      if (selection.severity(dialect::DiagnosticId{static_cast<std::uint8_t>(i)}) == severity) sum += counts_[i];
    return sum;
  }

 private:
  std::array<std::size_t, dialect::kDiagnosticCount> counts_{};
};

}  // namespace isocnc::analyzer
