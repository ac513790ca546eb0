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

Report with_run(Report found, const simulation::RunOutcome& run) {
  std::set<std::pair<std::size_t, dialect::DiagnosticId>> known;
  std::int32_t mistakes = 0;
  for (const LocatedFinding& located : found.findings) {
    known.emplace(located.line, located.finding.id);
    mistakes = std::max(mistakes, located.mistake + 1);
  }
  const auto middle = static_cast<std::ptrdiff_t>(found.findings.size());
  const auto first_path = static_cast<std::int32_t>(found.paths.size());
  for (const std::vector<simulation::RunDecision>& path : run.paths) {
    std::vector<check::PathStep>& steps = found.paths.emplace_back();
    for (const simulation::RunDecision& each : path) steps.push_back({each.line, each.taken});
  }
  for (const simulation::RunFinding& each : run.findings) {
    if (known.contains({each.line, each.finding.id})) continue;
    found.findings.push_back({.line = each.line,
                              .finding = each.finding,
                              .path = each.path < 0 ? LocatedFinding::kEveryPath : first_path + each.path,
                              .mistake = each.mistake < 0 ? -1 : mistakes + each.mistake,
                              .is_of_run = true,
                              .last_line = each.last_line,
                              .worst_line = each.worst_line,
                              .shaped_by = each.shaped_by});
  }
  std::inplace_merge(found.findings.begin(), found.findings.begin() + middle, found.findings.end(), by_place);
  return found;
}

/// Whether a run has come to a finding, on its path if it has one.
static bool has_come_to(const simulation::TakenPath& run, const LocatedFinding& located, const Report& report) {
  if (!run.has_executed(located.line)) return false;
  if (located.path == LocatedFinding::kEveryPath) return true;
  const std::vector<check::PathStep>& steps = report.paths[static_cast<std::size_t>(located.path)];
  return std::all_of(steps.begin(), steps.end(), [&](const check::PathStep& step) {
    return run.has_made({step.line, step.taken});
  });
}

Report without_tips(Report report, const simulation::RunOutcome& run, const Selection& selection) {
  // Where the spindle stands in the material, E158 says it better than W102 on the first feed.
  const bool has_cut_standing =
      selection.shows("cuts-with-spindle-stopped"_diag) &&
      std::any_of(run.findings.begin(), run.findings.end(), [](const simulation::RunFinding& each) {
        return each.finding.id == "cuts-with-spindle-stopped"_diag;
      });
  const auto is_judged_by_runs = [&](dialect::DiagnosticId id) {
    if (id == "travel-exceeded"_diag) return selection.shows("joint-travel"_diag);
    return id == "spindle-stopped-feed"_diag && has_cut_standing;
  };
  std::erase_if(report.findings, [&](const LocatedFinding& located) {
    return is_judged_by_runs(located.finding.id) &&
           std::any_of(run.runs.begin(), run.runs.end(),
                       [&](const simulation::TakenPath& taken) { return has_come_to(taken, located, report); });
  });
  return report;
}

/// What a run has looked for. Where something could not be verified, a finding may be missing for that reason.
static LookedFor looked_for_by(const simulation::RunOutcome& run) {
  const bool is_whole = std::none_of(run.findings.begin(), run.findings.end(), [](const simulation::RunFinding& each) {
    return each.finding.id == "not-verified"_diag;
  });
  return [&run, is_whole](dialect::DiagnosticId id, std::optional<std::size_t> line) {
    const dialect::Evidence evidence = dialect::definition(id).evidence;
    if (!is_whole || (evidence == dialect::Evidence::Scene && !run.has_scene) ||
        (evidence == dialect::Evidence::Stock && !run.has_stock))
      return false;
    return !line || std::any_of(run.runs.begin(), run.runs.end(),
                                [&](const simulation::TakenPath& taken) { return taken.has_executed(*line); });
  };
}

Report shown_report_with_run(Report found, const simulation::RunOutcome& run, std::string_view text,
                             const Selection& selection, const FindingFilter& filter) {
  const auto filter_both = [&](Report report, std::string_view of_text) {
    report = without_tips(std::move(report), run, selection);
    return filter ? filter(std::move(report), of_text) : report;
  };
  return shown_report(with_run(std::move(found), run), text, selection, filter_both, looked_for_by(run));
}

Report shown_report_with_run(Report found, const simulation::RunOutcome& run, bool whole,
                             const syntax::Document& document, Suppressions comments, const Selection& selection) {
  const auto filter = [&](Report report) { return without_tips(std::move(report), run, selection); };
  return shown_report(with_run(std::move(found), run), document, std::move(comments), selection, filter,
                      whole ? looked_for_by(run) : LookedFor());
}

Report shown_run_report(const simulation::RunOutcome& run, std::string_view text, const Selection& selection) {
  Report report = Suppressions(text).apply(selection.shown(with_run({}, run)), selection);
  // Comments about what a check finds are no mistakes.
  std::erase_if(report.findings,
                [](const LocatedFinding& located) { return located.finding.id == "useless-suppression"_diag; });
  return check::folded(std::move(report));
}

}  // namespace isocnc::selection
