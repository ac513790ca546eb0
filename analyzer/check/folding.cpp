#include "analyzer/check/folding.h"

#include <algorithm>
#include <utility>

#include "interpreter/dialect/diagnostic_id.h"

namespace isocnc::check {

using dialect::FoldKind;

/// The maximum number of mistakes of one kind that are followed at once; more come only from many paths.
static constexpr std::size_t kMaxOpen = 64;

void MistakeNumbers::start(const Outcome& outcome) {
  outcome_ = &outcome;
  next_end_ = 0;
}

void MistakeNumbers::end_folds_up_to(std::size_t line) {
  const std::vector<Outcome::FoldEnd>& ends = outcome_->fold_ends;
  for (; next_end_ < ends.size() && ends[next_end_].line <= line; ++next_end_)
    for (std::size_t fold = 0; fold < open_.size(); ++fold)
      if ((ends[next_end_].folds & fold_bit(static_cast<FoldKind>(fold))) != 0) open_[fold].clear();
}

void MistakeNumbers::finish() { end_folds_up_to(std::numeric_limits<std::size_t>::max()); }

std::int32_t MistakeNumbers::number(std::size_t line, dialect::DiagnosticId id, std::int32_t path_index) {
  static const Decisions kEveryPath;
  const FoldKind fold = dialect::definition(id).folds;
  if (fold == FoldKind::None) return -1;
  end_folds_up_to(line);
  const Decisions& path = path_index < 0 ? kEveryPath : outcome_->paths[static_cast<std::size_t>(path_index)];
  std::vector<Open>& open = open_[static_cast<std::size_t>(fold)];
  const auto known = std::find_if(open.begin(), open.end(), [&](const Open& each) { return each.path == path; });
  if (known == open.end()) {
    if (open.size() == kMaxOpen) open.erase(open.begin());
    open.push_back({path, count_, line, outcome_});
    return count_++;
  }
  // A second finding on a line stands for itself: what repeats is counted in lines.
  if (known->outcome == outcome_ && known->line == line) return -1;
  known->line = line;
  known->outcome = outcome_;
  return known->number;
}

bool Folder::fold(std::int32_t mistake, const Repetition& repetition, dialect::Severity severity, std::size_t index) {
  if (mistake < 0) return false;
  const auto number = static_cast<std::size_t>(mistake);
  if (number >= firsts_.size()) firsts_.resize(number + 1, {kNone, kNone, kNone});
  std::size_t& known = firsts_[number][static_cast<std::size_t>(severity)];
  if (known == kNone) {
    known = index;
    return false;
  }
  if (known == kLeftOut) return true;
  LocatedFinding& first = report_.findings[known];
  if (first.repetitions < 0) {
    first.repetitions = static_cast<std::int32_t>(report_.repetitions.size());
    report_.repetitions.emplace_back();
  }
  report_.repetitions[static_cast<std::size_t>(first.repetitions)].push_back(repetition);
  return true;
}

Report folded(Report report) {
  Folder folder(report);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < report.findings.size(); ++i) {
    if (folder.fold(report.findings[i], report.findings[i].severity(), kept)) continue;
    if (kept != i) report.findings[kept] = report.findings[i];
    ++kept;
  }
  report.findings.resize(kept);
  return report;
}

const Repetition* repetition_from(std::size_t line, const LocatedFinding& located, const Report& report) {
  const std::span<const Repetition> all = report.repetitions_of(located);
  const auto is_above = [&](const Repetition& each) { return each.line < line; };
  const auto place = std::partition_point(all.begin(), all.end(), is_above);
  return place != all.end() ? &*place : nullptr;
}

std::size_t folded_size(const Report& report) {
  Report none;
  Folder folder(none);
  return static_cast<std::size_t>(std::count_if(
      report.findings.begin(), report.findings.end(),
      [&](const LocatedFinding& located) { return !folder.fold(located, located.severity(), Folder::kLeftOut); }));
}

}  // namespace isocnc::check
