#include "analyzer/selection/joined_runs.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

namespace isocnc::selection {

using namespace dialect::literals;
using simulation::RunDecision;
using simulation::RunFinding;
using simulation::RunOutcome;
using simulation::TakenPath;

JoinedRuns::Identity JoinedRuns::identity_of(const RunFinding& each) {
  const syntax::Finding& finding = each.finding;
  const bool is_of_joint = finding.id == "joint-travel"_diag;
  // What is not known of a tool is not known wherever it is mounted.
  const bool is_of_tool =
      finding.has("not-verified/tool-without-shape"_cause) || finding.has("not-verified/tool-without-length"_cause);
  return {is_of_tool ? 0 : each.line,
          is_of_tool ? syntax::Span() : finding.span,
          finding.id,
          finding.cause,
          finding.names[0].number,
          finding.names[1].number,
          is_of_joint ? finding.values[0] : 0,   // The axis.
          is_of_joint ? finding.values[2] : 0};  // The end of its travel.
}

/// Whether one of two findings that are the same tells something worse: a contact that is deeper, or a near miss that
/// is nearer.
static bool is_worse(const syntax::Finding& a, const syntax::Finding& b) {
  constexpr std::array kByDepth = {"hits-fixture"_diag,
                                   "hits-machine"_diag,
                                   "gouges-part"_diag,
                                   "rapid-in-material"_diag,
                                   "holder-in-material"_diag,
                                   "cut-too-deep"_diag,
                                   "cuts-with-spindle-stopped"_diag};
  if (a.id == "near-miss"_diag) return a.values[0] < b.values[0];
  return std::find(kByDepth.begin(), kByDepth.end(), a.id) != kByDepth.end() && a.values[0] > b.values[0];
}

void JoinedRuns::add(RunOutcome outcome) {
  const RunSet run = RunSet{1} << joined_.runs.size();
  joined_.has_scene = outcome.has_scene;
  joined_.has_stock = outcome.has_stock;
  if (run == 1) joined_.removed = std::move(outcome.removed);
  joined_.runs.insert(joined_.runs.end(), outcome.runs.begin(), outcome.runs.end());
  std::map<std::int32_t, std::int32_t> mistakes;  // The numbers of this run's mistakes among those of all runs.
  for (RunFinding& each : outcome.findings) {
    const auto [known, is_new] = known_.emplace(identity_of(each), joined_.findings.size());
    // A run's own findings are all kept.
    const bool is_of_earlier_run = !is_new && (found_by_[known->second] & (run - 1)) != 0;
    if (each.mistake >= 0) {
      // A mistake that begins where an earlier run has found it is the same.
      const std::int32_t earlier = is_of_earlier_run ? joined_.findings[known->second].mistake : -1;
      const auto [number, begins] = mistakes.emplace(each.mistake, earlier >= 0 ? earlier : mistakes_);
      if (begins && earlier < 0) ++mistakes_;
      each.mistake = number->second;
    }
    if (is_of_earlier_run) {
      found_by_[known->second] |= run;
      RunFinding& earlier = joined_.findings[known->second];
      if (is_worse(each.finding, earlier.finding)) {
        earlier.finding = each.finding;
        earlier.worst_line = each.worst_line;
        earlier.shaped_by = each.shaped_by;
      }
      continue;
    }
    joined_.findings.push_back(std::move(each));
    found_by_.push_back(run);
  }
}

/// Whether some run has gone the other way at this IF.
bool JoinedRuns::is_made_otherwise(const RunDecision& decision) const {
  return std::any_of(joined_.runs.begin(), joined_.runs.end(), [&](const TakenPath& run) {
    return run.has_made({decision.line, !decision.taken});
  });
}

JoinedRuns::Detour JoinedRuns::detour_of(RunSet runs) const {
  Detour detour;
  const auto first = static_cast<std::size_t>(std::countr_zero(runs));
  for (const RunDecision& each : joined_.runs[first].decisions)
    if (!joined_.runs.front().has_made(each) && is_made_otherwise(each)) detour.of_one.push_back(each);
  detour.common = detour.of_one;
  for (std::size_t run = first + 1; run < joined_.runs.size(); ++run)
    if ((runs >> run & 1) != 0)
      std::erase_if(detour.common, [&](const RunDecision& each) { return !joined_.runs[run].has_made(each); });
  return detour;
}

/// The number of the path that leads these runs to a line.
std::int32_t JoinedRuns::path_number(std::size_t line, RunSet runs) {
  const auto place = detours_.find(runs);
  Detour& detour = place != detours_.end() ? place->second : detours_.emplace(runs, detour_of(runs)).first->second;
  const auto above = [line](const DecisionPath& path) {
    return std::partition_point(path.begin(), path.end(), [&](const RunDecision& each) { return each.line < line; });
  };
  const auto common_end = above(detour.common);
  const auto end_of_one = above(detour.of_one);
  const std::pair steps(static_cast<std::size_t>(common_end - detour.common.begin()),
                        static_cast<std::size_t>(end_of_one - detour.of_one.begin()));
  const auto [known, is_new] = detour.numbers.emplace(steps, static_cast<std::int32_t>(joined_.paths.size()));
  if (!is_new) return known->second;
  // Where the runs share no decision, one of several paths is better than none.
  joined_.paths.push_back(steps.first > 0
                              ? DecisionPath(detour.common.cbegin(), DecisionPath::const_iterator(common_end))
                              : DecisionPath(detour.of_one.cbegin(), DecisionPath::const_iterator(end_of_one)));
  return known->second;
}

RunOutcome JoinedRuns::finish() && {
  for (std::size_t i = 0; i < joined_.findings.size(); ++i)
    if ((found_by_[i] & 1) == 0) joined_.findings[i].path = path_number(joined_.findings[i].line, found_by_[i]);
  const auto is_before = [](const RunFinding& a, const RunFinding& b) {
    return std::pair(a.line, a.finding.span.begin) < std::pair(b.line, b.finding.span.begin);
  };
  std::stable_sort(joined_.findings.begin(), joined_.findings.end(), is_before);
  return std::move(joined_);
}

}  // namespace isocnc::selection
