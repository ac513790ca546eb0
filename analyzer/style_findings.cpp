#include "analyzer/style_findings.h"

#include <algorithm>

#include "analyzer/style/rule.h"

namespace isocnc::analyzer {

Report with_style(Report report, std::string_view text, const Selection& selection) {
  const std::vector<style::Remark> remarks =
      style::read_program(text, [&](dialect::DiagnosticId id) { return selection.shows(id); });
  if (remarks.empty()) return report;
  for (const style::Remark& remark : remarks) report.findings.push_back({remark.line, remark.finding});
  std::stable_sort(report.findings.begin(), report.findings.end(),
                   [](const LocatedFinding& a, const LocatedFinding& b) {
                     return a.line != b.line ? a.line < b.line : a.finding.span.begin < b.finding.span.begin;
                   });
  return report;
}

}  // namespace isocnc::analyzer
