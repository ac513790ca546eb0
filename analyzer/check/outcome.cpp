#include "analyzer/check/outcome.h"

#include <algorithm>

namespace isocnc::check {

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

void Outcome::count() {
  tally.clear();
  for (const LocatedFinding& located : findings) {
    const auto same = [&](const auto& counted) { return counted.first == located.finding.id; };
    const auto known = std::find_if(tally.begin(), tally.end(), same);
    if (known == tally.end()) {
      tally.emplace_back(located.finding.id, 1);
    } else {
      ++known->second;
    }
  }
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
