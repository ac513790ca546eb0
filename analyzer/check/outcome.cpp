#include "analyzer/check/outcome.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "interpreter/dialect/diagnostic_id.h"

namespace isocnc::check {

using namespace dialect::literals;

bool assumes_all_paths(dialect::DiagnosticId id) {
  static constexpr dialect::DiagnosticId kAll[] = {"never-runs"_diag,           "condition-decided"_diag,
                                                   "spindle-stopped-feed"_diag, "spindle-reversed"_diag,
                                                   "spindle-started-late"_diag, "tool-change-with-spindle-on"_diag,
                                                   "end-with-spindle-on"_diag};
  return std::find(std::begin(kAll), std::end(kAll), id) != std::end(kAll);
}

bool needs_look(dialect::DiagnosticId id) {
  static const std::array<bool, dialect::kDiagnosticCount> kNeedsLook = [] {
    std::array<bool, dialect::kDiagnosticCount> needs{};
    for (std::size_t i = 0; i < needs.size(); ++i) {
      const dialect::DiagnosticId each{static_cast<std::uint8_t>(i)};
      needs[i] = dialect::definition(each).folds != dialect::FoldKind::None || assumes_all_paths(each) ||
                 each == "label-not-found"_diag;
    }
    return needs;
  }();
  return kNeedsLook[static_cast<std::size_t>(id)];
}

void Outcome::clear() { *this = Outcome{}; }

void Outcome::report(const LocatedFinding& located) {
  ended_folds &= static_cast<FoldSet>(~fold_bit(dialect::definition(located.finding.id).folds));
  findings.push_back(located);
}

void Outcome::end_folds(FoldSet folds, std::size_t line) {
  const auto ending = static_cast<FoldSet>(folds & ~ended_folds);
  if (ending == 0) return;
  fold_ends.push_back({line, ending});
  ended_folds |= ending;
}

void Outcome::append(Outcome next, std::size_t first_line) {
  const auto first_path = static_cast<std::int32_t>(paths.size());
  for (LocatedFinding& located : next.findings) {
    located.line += first_line;
    if (located.path >= 0) located.path += first_path;
    findings.push_back(located);
  }
  std::move(next.paths.begin(), next.paths.end(), std::back_inserter(paths));
  for (const Label& label : next.labels)
    labels.push_back({label.label, first_line + label.line, label.span, label.live});
  live_jumps.insert(live_jumps.end(), next.live_jumps.begin(), next.live_jumps.end());
  if (next.has_text) last_text_line = first_line + next.last_text_line;
  has_text |= next.has_text;
  assigned |= next.assigned;
  may_assign |= next.may_assign;
  positions.read |= static_cast<execution::AxisSet>(next.positions.read & ~positions.set);
  positions.set |= next.positions.set;
  positions.by_several |= next.positions.by_several;
  positions.far |= next.positions.far;
  centers.from_start |= next.centers.from_start;
  centers.open |= next.centers.open;
  if (next.leads_anywhere_from != kNowhere)
    leads_anywhere_from = std::min(leads_anywhere_from, first_line + next.leads_anywhere_from);
  misspelled_labels.insert(misspelled_labels.end(), next.misspelled_labels.begin(), next.misspelled_labels.end());
  for (const auto& [line, folds] : next.fold_ends) fold_ends.push_back({first_line + line, folds});
  ended_folds = next.ended_folds;
}

static Outcome::Look look_at(const LocatedFinding& located) {
  return {.line = static_cast<std::uint32_t>(located.line),
          .path = located.path,
          .span = located.finding.span,
          .id = located.finding.id,
          .label = located.finding.id == "label-not-found"_diag ? located.finding.values[0] : 0};
}

void Outcome::count() {
  tally.clear();
  looks.clear();
  sort_once(misspelled_labels);
  for (const LocatedFinding& located : findings) {
    if (needs_look(located.finding.id)) looks.push_back(look_at(located));
    const auto same = [&](const auto& counted) { return counted.first == located.finding.id; };
    const auto known = std::find_if(tally.begin(), tally.end(), same);
    if (known == tally.end()) {
      tally.emplace_back(located.finding.id, 1);
    } else {
      ++known->second;
    }
  }
  looks.shrink_to_fit();
}

void FindingCounts::add(const Outcome& outcome) {
  for (const auto& [id, number] : outcome.tally) {
    counts_[static_cast<std::size_t>(id)] += number;
    all_ += number;
  }
}

void FindingCounts::remove(const Outcome& outcome) {
  for (const auto& [id, number] : outcome.tally) {
    counts_[static_cast<std::size_t>(id)] -= number;
    all_ -= number;
  }
}

}  // namespace isocnc::check
