#include "analyzer/revisions/finding_changes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>

#include "interpreter/comparison/comparison.h"
#include "interpreter/dialect/codes.h"
#include "interpreter/syntax/line_finder.h"
#include "interpreter/syntax/tree_store.h"

namespace isocnc::revisions {

using namespace dialect::literals;
using comparison::AlignedStep;
using comparison::MachineAction;

namespace {

/// Findings about the same in one part of both runs are this many at most among which one is looked for.
constexpr std::size_t kMaxCandidates = 256;

/// What a finding is about, without its measure. Names from outside the programs count by their texts.
using FindingSubject = std::tuple<dialect::DiagnosticId, std::uint8_t, std::uint32_t, std::uint32_t, double, double>;

/// A length of a finding, mm to a thousandth: the units of the programs may differ.
double in_mm(const syntax::Finding& finding, double length) {
  return std::round(length * dialect::mm_per_unit(finding.is_in_inches) * 1000) / 1000;
}

FindingSubject subject_of(const syntax::Finding& finding) {
  const bool is_of_joint = finding.id == "joint-travel"_diag;
  return {finding.id,
          finding.cause,
          finding.names[0].number,
          finding.names[1].number,
          is_of_joint ? finding.values[0] : 0,                   // The axis.
          is_of_joint ? in_mm(finding, finding.values[2]) : 0};  // The end of its travel.
}

/// Whether two findings about the same say the same. Places and times of contacts are where and when the machine is.
bool has_same_measure(const syntax::Finding& one, const syntax::Finding& other) {
  constexpr double kShown = 0.02;  // Messages round to 0.01.
  const dialect::Evidence evidence = dialect::definition(one.id).evidence;
  const bool is_of_scene = evidence == dialect::Evidence::Scene || evidence == dialect::Evidence::Stock;
  for (std::size_t i = 0; i < one.values.size(); ++i) {
    if (is_of_scene && i > 0 && i < 5) continue;
    const double in_unit = std::abs(one.values[i] - other.values[i]);
    const double length = std::abs(in_mm(one, one.values[i]) - in_mm(other, other.values[i]));
    if (std::min(in_unit, length) > kShown) return false;
  }
  return true;
}

/// The S or F that a finding is about, in its unit; none of others, and of a line without one.
std::optional<double> quoted_number(const check::LocatedFinding& located, std::string_view text) {
  const bool is_of_speed = located.finding.id == "spindle-speed-above-machine"_diag;
  if (!is_of_speed && located.finding.id != "feed-above-machine"_diag) return std::nullopt;
  const syntax::ParsedLine line(text);
  const std::int32_t word = is_of_speed ? line.tree().spindle : line.tree().feed;
  if (word < 0) return std::nullopt;
  const syntax::Word& number = line.tree().words[static_cast<std::size_t>(word)];
  return number.known() ? std::optional(number.value) : std::nullopt;
}

/// Whether two of these are the same, be it in millimeters and inches.
bool is_same_number(const std::optional<double>& one, const std::optional<double>& other) {
  if (!one || !other) return true;
  const auto is_near = [&](double scale) { return std::abs(*one * scale - *other) <= 1e-3 * std::abs(*other); };
  return is_near(1) || is_near(dialect::mm_per_unit(true)) || is_near(1 / dialect::mm_per_unit(true));
}

/// A finding, and the steps of both runs that its lines have a part in.
struct PlacedFinding {
  std::size_t index = 0;
  FindingSubject subject;
  std::optional<double> number;  ///< quoted_number()
  std::size_t first_step = 0;
  std::size_t last_step_of_line = 0;  ///< Of its first line.
  std::size_t last_step = 0;          ///< Of the last line that shows the same mistake.
  bool is_matched = false;
};

/// Whether two mistakes begin in the same place.
bool begin_together(const PlacedFinding& one, const PlacedFinding& other) {
  return one.first_step <= other.last_step_of_line && other.first_step <= one.last_step_of_line;
}

/// The findings of a run. `end_of` is the end of a step in this run.
template <class EndOf>
std::vector<PlacedFinding> placed(const RevisionRun& run, const std::vector<AlignedStep>& steps, const EndOf& end_of) {
  const std::vector<MachineAction>& actions = run.recorded.actions;
  const auto first_from = [&](std::size_t line) {
    const auto action = std::partition_point(actions.begin(), actions.end(),
                                             [&](const MachineAction& each) { return each.line < line; });
    return static_cast<std::size_t>(action - actions.begin());
  };
  const auto step_of = [&](std::size_t action) {
    const auto step = std::partition_point(steps.begin(), steps.end(),
                                           [&](const AlignedStep& each) { return end_of(each) <= action; });
    return static_cast<std::size_t>(step - steps.begin());
  };
  std::vector<PlacedFinding> found;
  syntax::LineFinder lines(run.text);
  for (std::size_t i = 0; i < run.findings.findings.size(); ++i) {
    const check::LocatedFinding& located = run.findings.findings[i];
    const std::size_t first = std::min(first_from(located.line), actions.size() - 1);
    const auto last_step_of = [&](std::size_t line) { return step_of(std::max(first + 1, first_from(line + 1)) - 1); };
    const std::span<const check::Repetition> repetitions = run.findings.repetitions_of(located);
    found.push_back({.index = i,
                     .subject = subject_of(located.finding),
                     .number = quoted_number(located, lines.line(located.line)),
                     .first_step = step_of(first),
                     .last_step_of_line = last_step_of(located.line),
                     .last_step = last_step_of(repetitions.empty() ? located.line : repetitions.back().line)});
  }
  return found;
}

}  // namespace

std::vector<FindingChange> finding_changes(const RevisionRun& old_run, const RevisionRun& new_run, double tolerance) {
  if (old_run.findings.findings.empty() && new_run.findings.findings.empty()) return {};
  const std::vector<AlignedStep> steps = aligned_steps(old_run.recorded, new_run.recorded, tolerance);
  std::vector<PlacedFinding> of_old = placed(old_run, steps, [](const AlignedStep& each) { return each.old_end; });
  std::vector<PlacedFinding> of_new = placed(new_run, steps, [](const AlignedStep& each) { return each.new_end; });
  std::map<FindingSubject, std::vector<PlacedFinding*>> known;
  for (PlacedFinding& each : of_new) known[each.subject].push_back(&each);
  const auto finding = [](const RevisionRun& run, std::size_t index) -> const syntax::Finding& {
    return run.findings.findings[index].finding;
  };
  std::vector<std::pair<std::size_t, FindingChange>> changes;  // With their steps.
  for (const bool is_exact : {true, false}) {
    std::map<FindingSubject, std::size_t> starts;  // No earlier one can belong to what follows.
    for (PlacedFinding& each : of_old) {
      if (each.is_matched) continue;
      const std::vector<PlacedFinding*>& candidates = known[each.subject];
      std::size_t& start = starts[each.subject];
      while (start < candidates.size() &&
             (candidates[start]->is_matched || candidates[start]->last_step < each.first_step))
        ++start;
      const std::size_t end = std::min(candidates.size(), start + kMaxCandidates);
      for (std::size_t k = start; k < end && candidates[k]->first_step <= each.last_step; ++k) {
        PlacedFinding& other = *candidates[k];
        if (other.is_matched || other.last_step < each.first_step) continue;
        const bool is_same = begin_together(each, other) && is_same_number(each.number, other.number) &&
                             has_same_measure(finding(old_run, each.index), finding(new_run, other.index));
        if (is_exact && !is_same) continue;
        each.is_matched = other.is_matched = true;
        if (!is_same)
          changes.emplace_back(other.first_step, FindingChange{FindingChangeKind::Changed, each.index, other.index});
        break;
      }
    }
  }
  for (const PlacedFinding& each : of_old)
    if (!each.is_matched)
      changes.emplace_back(each.first_step, FindingChange{FindingChangeKind::Gone, each.index, std::nullopt});
  for (const PlacedFinding& each : of_new)
    if (!each.is_matched)
      changes.emplace_back(each.first_step, FindingChange{FindingChangeKind::New, std::nullopt, each.index});
  std::stable_sort(changes.begin(), changes.end(),
                   [](const auto& one, const auto& other) { return one.first < other.first; });
  std::vector<FindingChange> sorted;
  for (const auto& [step, change] : changes) sorted.push_back(change);
  return sorted;
}

}  // namespace isocnc::revisions
