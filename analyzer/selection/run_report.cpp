#include "analyzer/selection/run_report.h"

#include <algorithm>
#include <set>
#include <utility>

#include "analyzer/check/folding.h"
#include "analyzer/selection/suppressions.h"
#include "interpreter/dialect/diagnostic_id.h"

namespace isocnc::selection {

using namespace dialect::literals;
using check::LocatedFinding;
using check::Report;

static bool by_place(const LocatedFinding& a, const LocatedFinding& b) {
  return a.line != b.line ? a.line < b.line : a.finding.span.begin < b.finding.span.begin;
}

Report with_run(Report found, std::span<const simulation::RunFinding> run) {
  std::set<std::pair<std::size_t, dialect::DiagnosticId>> known;
  std::int32_t mistakes = 0;
  for (const LocatedFinding& located : found.findings) {
    known.emplace(located.line, located.finding.id);
    mistakes = std::max(mistakes, located.mistake + 1);
  }
  const auto middle = static_cast<std::ptrdiff_t>(found.findings.size());
  for (const simulation::RunFinding& each : run) {
    if (known.contains({each.line, each.finding.id})) continue;
    found.findings.push_back({.line = each.line,
                              .finding = each.finding,
                              .mistake = each.mistake < 0 ? -1 : mistakes + each.mistake,
                              .is_of_run = true,
                              .last_line = each.last_line});
  }
  std::inplace_merge(found.findings.begin(), found.findings.begin() + middle, found.findings.end(), by_place);
  return found;
}

Report without_tips(Report report, const simulation::RunOutcome& run, const Selection& selection) {
  if (!selection.shows("joint-travel"_diag)) return report;
  std::erase_if(report.findings, [&](const LocatedFinding& located) {
    const bool is_of_every_path = located.path == LocatedFinding::kEveryPath;
    return located.finding.id == "travel-exceeded"_diag && is_of_every_path && run.has_executed(located.line);
  });
  return report;
}

Report shown_report_with_run(Report found, const simulation::RunOutcome& run, std::string_view text,
                             const Selection& selection, const FindingFilter& filter) {
  const auto filter_both = [&](Report report, std::string_view of_text) {
    report = without_tips(std::move(report), run, selection);
    return filter ? filter(std::move(report), of_text) : report;
  };
  return shown_report(with_run(std::move(found), run.findings), text, selection, filter_both);
}

Report shown_report_with_run(Report found, const simulation::RunOutcome& run, const syntax::Document& document,
                             Suppressions comments, const Selection& selection) {
  const auto filter = [&](Report report) { return without_tips(std::move(report), run, selection); };
  return shown_report(with_run(std::move(found), run.findings), document, std::move(comments), selection, filter);
}

Report shown_run_report(const simulation::RunOutcome& run, std::string_view text, const Selection& selection) {
  Report report = Suppressions(text).apply(selection.shown(with_run({}, run.findings)), selection);
  // Comments about what a check finds are no mistakes.
  std::erase_if(report.findings,
                [](const LocatedFinding& located) { return located.finding.id == "useless-suppression"_diag; });
  return check::folded(std::move(report));
}

}  // namespace isocnc::selection
