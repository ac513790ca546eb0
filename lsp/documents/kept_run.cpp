#include "lsp/documents/kept_run.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <unordered_set>
#include <utility>
#include <vector>

namespace isocnc::documents {

using simulation::RunFinding;

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
  std::erase_if(outcome_.findings, [&](const RunFinding& each) { return each.line >= first && each.line < after; });
  for (RunFinding& each : outcome_.findings) {
    if (each.line >= after) each.line = each.line - removed + inserted;
    if (!each.last_line || *each.last_line < first) continue;
    each.last_line = *each.last_line < after ? std::nullopt : std::optional(*each.last_line - removed + inserted);
  }
  std::vector<std::pair<std::size_t, std::size_t>> executed;
  executed.reserve(outcome_.executed.size() + 1);
  for (const auto& [begin, last] : outcome_.executed) {
    if (begin < first) executed.emplace_back(begin, std::min(last, first - 1));
    if (last >= after) executed.emplace_back(std::max(begin, after) - removed + inserted, last - removed + inserted);
  }
  outcome_.executed = std::move(executed);
}

}  // namespace isocnc::documents
