#include "lsp/documents/kept_run.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <unordered_set>
#include <utility>
#include <vector>

namespace isocnc::documents {

using simulation::RunDecision;
using simulation::RunFinding;
using simulation::TakenPath;

/// Whether each finding is the first of its mistake.
static std::vector<bool> are_first(const std::vector<RunFinding>& findings) {
  std::vector<bool> first;
  first.reserve(findings.size());
  std::unordered_set<std::int32_t> mistakes;
  for (const RunFinding& each : findings) first.push_back(each.mistake < 0 || mistakes.insert(each.mistake).second);
  return first;
}

KeptRun::KeptRun(simulation::RunOutcome outcome) : outcome_(std::move(outcome)) {
  std::vector<RunFinding>& findings = outcome_.findings;
  if (findings.size() <= kMaxFindings) return;
  const std::vector<bool> is_first = are_first(findings);
  const auto firsts = static_cast<std::size_t>(std::count(is_first.begin(), is_first.end(), true));
  std::size_t firsts_left = std::min(firsts, kMaxFindings);
  std::size_t repetitions_left = kMaxFindings - firsts_left;
  left_out_ = firsts - firsts_left;
  std::vector<RunFinding> kept;
  kept.reserve(kMaxFindings);
  for (std::size_t i = 0; i < findings.size(); ++i) {
    std::size_t& left = is_first[i] ? firsts_left : repetitions_left;
    if (left == 0) continue;
    --left;
    kept.push_back(findings[i]);
  }
  findings = std::move(kept);
}

void KeptRun::replace_lines(std::size_t first, std::size_t removed, std::size_t inserted) {
  const std::size_t after = first + removed;  // The first line that moves.
  const auto is_replaced = [&](std::size_t line) { return line >= first && line < after; };
  const auto moved = [&](std::size_t line) { return line < after ? line : line - removed + inserted; };
  // Of a line that an edit may have taken away.
  const auto moved_if_kept = [&](const std::optional<std::size_t>& line) {
    return !line || is_replaced(*line) ? std::nullopt : std::optional(moved(*line));
  };
  // Findings to which an edited jump leads are about that line, too.
  std::vector<bool> is_path_lost;
  for (std::vector<RunDecision>& path : outcome_.paths) {
    is_path_lost.push_back(
        std::any_of(path.begin(), path.end(), [&](const auto& step) { return is_replaced(step.line); }));
    for (RunDecision& step : path) step.line = moved(step.line);
  }
  std::erase_if(outcome_.findings, [&](const RunFinding& each) {
    return is_replaced(each.line) || (each.path >= 0 && is_path_lost[static_cast<std::size_t>(each.path)]);
  });
  for (RunFinding& each : outcome_.findings) {
    each.line = moved(each.line);
    each.last_line = moved_if_kept(each.last_line);
    each.worst_line = moved_if_kept(each.worst_line);
    each.shaped_by = moved_if_kept(each.shaped_by);
  }
  std::erase_if(outcome_.removed, [&](const simulation::RemovedOnLine& each) { return is_replaced(each.line); });
  for (simulation::RemovedOnLine& each : outcome_.removed) each.line = moved(each.line);
  for (TakenPath& run : outcome_.runs) {
    std::vector<std::pair<std::size_t, std::size_t>> executed;
    executed.reserve(run.executed.size() + 1);
    for (const auto& [begin, last] : run.executed) {
      if (begin < first) executed.emplace_back(begin, std::min(last, first - 1));
      if (last >= after) executed.emplace_back(moved(std::max(begin, after)), moved(last));
    }
    run.executed = std::move(executed);
    std::erase_if(run.decisions, [&](const RunDecision& each) { return is_replaced(each.line); });
    for (RunDecision& each : run.decisions) each.line = moved(each.line);
  }
}

}  // namespace isocnc::documents
