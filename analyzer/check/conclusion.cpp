#include "analyzer/check/conclusion.h"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "analyzer/check/folding.h"
#include "interpreter/syntax/tree_store.h"
#include "interpreter/text/characters.h"

namespace isocnc::check {

using namespace dialect::literals;
using syntax::Finding;
using syntax::LineTree;

bool all_jumps_resolve(const Outcome& outcome, const JumpMap& jumps) {
  std::unordered_map<std::uint64_t, std::size_t> last_lines;
  for (const Outcome::Label& label : outcome.labels) last_lines[label.label] = label.line;
  return std::all_of(outcome.live_jumps.begin(), outcome.live_jumps.end(), [&](std::uint32_t ordinal) {
    const JumpMap::Site& site = jumps.sites()[ordinal];
    const auto last = last_lines.find(site.jump.target);
    return last != last_lines.end() && last->second > site.line;
  });
}

/// A label that a GOTO names must be defined once: reports each later definition that the control reads (D50, D51).
static void add_duplicate_labels(const std::vector<PlacedOutcome>& outcomes, const JumpMap& jumps,
                                 std::vector<LocatedFinding>& findings) {
  std::unordered_set<std::uint64_t> seen;
  std::vector<std::pair<std::uint64_t, LocatedFinding>> repeated;
  for (const auto& [outcome, first_line] : outcomes)
    for (const Outcome::Label& label : outcome->labels)
      if (label.live && jumps.may_repeat(label.label) && !seen.insert(label.label).second)
        repeated.push_back(
            {label.label, {first_line + label.line, {.id = "duplicate-label"_diag, .span = label.span}}});
  if (repeated.empty()) return;
  std::unordered_map<std::uint64_t, bool> is_named;
  for (const auto& [label, finding] : repeated) is_named[label] = false;
  for (const auto& [outcome, first_line] : outcomes)
    for (const std::uint32_t jump : outcome->live_jumps) {
      if (jumps.target_of(jump) != JumpMap::Target::Below) continue;
      const auto named = is_named.find(jumps.sites()[jump].jump.target);
      if (named != is_named.end()) named->second = true;
    }
  for (const auto& [label, finding] : repeated)
    if (is_named[label]) findings.push_back(finding);
}

/// Registers that an IF compares and no line assigns, reported at the first such IF.
static void add_unassigned_registers(const std::vector<PlacedOutcome>& outcomes, const JumpMap& jumps,
                                     std::vector<LocatedFinding>& findings) {
  RegisterSet unassigned = jumps.compared();
  for (auto placed = outcomes.begin(); placed != outcomes.end() && unassigned != 0; ++placed)
    unassigned &= ~placed->outcome->assigned;
  if (unassigned == 0) return;
  for (const auto& [outcome, first_line] : outcomes)
    for (const std::uint32_t ordinal : outcome->live_jumps) {
      const JumpMap::Site& site = jumps.sites()[ordinal];
      const int reg = site.jump.variable;
      if (reg < 1 || !site.jump.condition_is_known() || (unassigned & register_bit(reg)) == 0) continue;
      unassigned &= ~register_bit(reg);
      findings.push_back({site.line, {.id = "register-never-assigned"_diag, .span = site.jump.variable_span}});
    }
}

static syntax::Span without_blanks(std::string_view text) {
  const std::string_view inner = text::trimmed(text);
  const auto begin = static_cast<std::uint32_t>(inner.data() - text.data());
  return {begin, begin + static_cast<std::uint32_t>(inner.size())};
}

/// Whether a line with a finding may have been meant as M02: `(M02`, `M`, `MO2`, `M0`, `N02`, or `02` alone (D58).
static bool may_hide_end(std::string_view text) {
  const syntax::ParsedLine parsed(text);
  const LineTree tree = parsed.tree();
  if (tree.has(LineTree::kUnclosed)) return true;
  return std::any_of(tree.words.begin(), tree.words.end(), [&](const syntax::Word& word) {
    if (word.letter == syntax::kNumber) return word.value == dialect::kProgramEnd && tree.instructions.empty();
    if (word.letter == 'N') return word.value == dialect::kProgramEnd && !tree.findings.empty();  // N90 N02
    return word.letter == 'M' && (!word.known() || word.has(syntax::Word::kMalformed));
  });
}

/// A path that reaches the end of the file without an M02: reported on the last line with any text (D47).
static void add_missing_end(const std::vector<PlacedOutcome>& outcomes, const Frontier& end,
                            const std::function<std::string_view(std::size_t)>& text_of_line,
                            std::vector<Decisions>& paths, std::vector<LocatedFinding>& findings) {
  if (end.live.empty()) return;
  LocatedFinding located{0, {.id = "m02-missing"_diag}};
  const auto last = std::find_if(outcomes.rbegin(), outcomes.rend(),
                                 [](const PlacedOutcome& placed) { return placed.outcome->has_text; });
  if (last != outcomes.rend()) {
    located.line = last->first_line + last->outcome->last_text_line;
    const std::string_view text = text_of_line(located.line);
    if (may_hide_end(text)) return;
    located.finding.span = without_blanks(text);
  }
  Decisions path = end.live[0].path;
  for (const Group& group : end.live)
    std::erase_if(path, [&](const Decision& decision) {
      return !decision.taken || std::find(group.path.begin(), group.path.end(), decision) == group.path.end();
    });
  if (!path.empty()) {
    located.path = static_cast<std::int32_t>(paths.size());
    paths.push_back(std::move(path));
  }
  findings.push_back(located);
}

/// Findings reported once per program, however many paths have them (D44).
static constexpr dialect::DiagnosticId kReportedOnce[] = {"initial-tool-missing"_diag, "feed-missing"_diag,
                                                          "too-many-paths"_diag};

static void keep_first_of_each(std::vector<LocatedFinding>& findings) {
  for (const dialect::DiagnosticId id : kReportedOnce) {
    bool seen = false;
    std::erase_if(findings, [&](const LocatedFinding& located) {
      if (located.finding.id != id) return false;
      return std::exchange(seen, true);
    });
  }
}

static bool by_place(const LocatedFinding& a, const LocatedFinding& b) {
  return a.line != b.line ? a.line < b.line : a.finding.span.begin < b.finding.span.begin;
}

/// Adds the findings that need the whole program.
static void add_findings_of_whole(const std::vector<PlacedOutcome>& outcomes, const Frontier& end, const JumpMap& jumps,
                                  const std::function<std::string_view(std::size_t)>& text_of_line,
                                  std::vector<Decisions>& paths, std::vector<LocatedFinding>& findings) {
  add_duplicate_labels(outcomes, jumps, findings);
  if (!end.reduced) add_unassigned_registers(outcomes, jumps, findings);
  add_missing_end(outcomes, end, text_of_line, paths, findings);
}

/// Sorts the findings and converts their paths to steps for users.
static void put_in_order(Report& report, const std::vector<Decisions>& paths, const JumpMap& jumps) {
  if (!std::is_sorted(report.findings.begin(), report.findings.end(), by_place))
    std::stable_sort(report.findings.begin(), report.findings.end(), by_place);
  keep_first_of_each(report.findings);
  for (const Decisions& path : paths) {
    std::vector<PathStep>& steps = report.paths.emplace_back();
    for (auto decision = path.rbegin(); decision != path.rend(); ++decision)
      steps.push_back({jumps.sites()[decision->jump].line, decision->taken});
  }
}

/// Whether a finding says that a label is missing (E004) that has been misspelled, which has been reported there.
/// `misspelled` is sorted.
static bool is_reported_at_label(dialect::DiagnosticId id, double label, const std::vector<double>& misspelled) {
  return id == "label-not-found"_diag && std::binary_search(misspelled.begin(), misspelled.end(), label);
}
static bool is_reported_at_label(const Finding& finding, const std::vector<double>& misspelled) {
  return is_reported_at_label(finding.id, finding.values[0], misspelled);
}

Report conclude(Outcome outcome, const Frontier& end, const JumpMap& jumps,
                const std::function<std::string_view(std::size_t)>& text_of_line) {
  MistakeNumbers mistakes;
  std::sort(outcome.misspelled_labels.begin(), outcome.misspelled_labels.end());
  std::erase_if(outcome.findings, [&](const LocatedFinding& located) {
    return (assumes_all_paths(located.finding.id) && located.line > outcome.leads_anywhere_from) ||
           is_reported_at_label(located.finding, outcome.misspelled_labels);
  });
  mistakes.start(outcome);
  for (LocatedFinding& located : outcome.findings)
    located.mistake = mistakes.number(located.line, located.finding.id, located.path);
  std::vector<Decisions> paths = std::move(outcome.paths);
  std::vector<LocatedFinding> findings = std::move(outcome.findings);
  add_findings_of_whole({{&outcome, 0}}, end, jumps, text_of_line, paths, findings);
  Report report;
  report.findings = std::move(findings);
  put_in_order(report, paths, jumps);
  return report;
}

namespace {

/// Takes findings up to the maximum, and counts the others.
class ExcerptCollector {
 public:
  ExcerptCollector(const FirstFindingsOptions& options, FirstFindings& excerpt)
      : options_(options), excerpt_(excerpt), folder_(excerpt.report) {}

  bool has_enough() const { return taken_ >= options_.max; }
  /// The line after the last finding taken.
  std::size_t end() const { return end_; }

  /// Takes the findings of an outcome; all outcomes must come, in their order. Once there are enough, takes
  /// repetitions only, and counts the other findings that need a look.
  void take(const PlacedOutcome& placed) {
    mistakes_.start(*placed.outcome);
    if (has_enough()) {
      for (const Outcome::Look& look : placed.outcome->looks) take(look, placed);
    } else {
      take_findings(placed);
    }
    mistakes_.finish();
    leads_anywhere_ |= placed.outcome->leads_anywhere_from != Outcome::kNowhere;
  }
  void take(const LocatedFinding& located) {
    findings().push_back(located);
    end_ = located.line + 1;
    if (counts(located.finding.id)) ++taken_;
  }
  void count(dialect::DiagnosticId id, std::size_t number = 1) {
    if (is_reported_once(id)) number = 1;
    if (counts(id)) excerpt_.left_out += number;
  }

  std::vector<LocatedFinding>& findings() { return excerpt_.report.findings; }
  std::vector<Decisions> paths;
  std::vector<double> misspelled_labels;  ///< Of all outcomes, sorted, before the first is taken.

 private:
  static bool is_reported_once(dialect::DiagnosticId id) {
    return std::find(std::begin(kReportedOnce), std::end(kReportedOnce), id) != std::end(kReportedOnce);
  }
  std::optional<dialect::Severity> severity(dialect::DiagnosticId id) const {
    return options_.severity ? options_.severity(id) : dialect::definition(id).severity;
  }
  bool counts(dialect::DiagnosticId id) {
    for (std::size_t i = 0; i < std::size(kReportedOnce); ++i)
      if (kReportedOnce[i] == id && std::exchange(reported_[i], true)) return false;
    return severity(id).has_value();
  }
  bool is_repetition(std::int32_t mistake, const Repetition& repetition, std::size_t index) {
    if (!options_.folds || mistake < 0) return false;
    const std::optional<dialect::Severity> shown = severity(repetition.id);
    return shown && folder_.fold(mistake, repetition, *shown, index);
  }
  /// Whether a finding does not count: after a jump that may lead anywhere, or because its label is misspelled.
  bool is_void(dialect::DiagnosticId id, std::size_t line, double label, const Outcome& outcome) const {
    const bool may_run = leads_anywhere_ || line > outcome.leads_anywhere_from;
    return (may_run && assumes_all_paths(id)) || is_reported_at_label(id, label, misspelled_labels);
  }

  void take_findings(const PlacedOutcome& placed) {
    const Outcome& outcome = *placed.outcome;
    const auto first_path = static_cast<std::int32_t>(paths.size());
    for (LocatedFinding located : outcome.findings) {
      const dialect::DiagnosticId id = located.finding.id;
      if (is_void(id, located.line, located.finding.values[0], outcome)) continue;
      located.mistake = mistakes_.number(located.line, id, located.path);
      located.line += placed.first_line;
      if (located.path >= 0) located.path += first_path;
      if (!is_repetition(located.mistake, {located.line, id, located.finding.span}, findings().size())) take(located);
    }
    paths.insert(paths.end(), outcome.paths.begin(), outcome.paths.end());
  }

  void take(const Outcome::Look& look, const PlacedOutcome& placed) {
    if (is_void(look.id, look.line, look.label, *placed.outcome)) return;
    const std::int32_t mistake = mistakes_.number(look.line, look.id, look.path);
    if (!is_repetition(mistake, {look.line + placed.first_line, look.id, look.span}, Folder::kLeftOut)) count(look.id);
  }

  const FirstFindingsOptions& options_;
  FirstFindings& excerpt_;
  MistakeNumbers mistakes_;
  Folder folder_;
  bool leads_anywhere_ = false;
  std::size_t taken_ = 0;
  std::size_t end_ = 0;
  std::array<bool, std::size(kReportedOnce)> reported_{};
};

}  // namespace

FirstFindings conclude(const std::vector<PlacedOutcome>& outcomes, const FindingCounts& counts, const Frontier& end,
                       const JumpMap& jumps, const std::function<std::string_view(std::size_t)>& text_of_line,
                       const FirstFindingsOptions& options) {
  FirstFindings excerpt;
  ExcerptCollector collector(options, excerpt);
  for (const PlacedOutcome& placed : outcomes)
    collector.misspelled_labels.insert(collector.misspelled_labels.end(), placed.outcome->misspelled_labels.begin(),
                                       placed.outcome->misspelled_labels.end());
  sort_once(collector.misspelled_labels);
  FindingCounts left = counts;
  bool has_all = true;
  for (const PlacedOutcome& placed : outcomes) {
    has_all = !collector.has_enough();
    if (has_all) left.remove(*placed.outcome);
    collector.take(placed);
  }
  for (std::size_t i = 0; i < dialect::kDiagnosticCount; ++i) {
    const dialect::DiagnosticId id{static_cast<std::uint8_t>(i)};
    if (left.of(id) > 0 && !needs_look(id)) collector.count(id, left.of(id));
  }
  std::vector<LocatedFinding> of_whole;
  add_findings_of_whole(outcomes, end, jumps, text_of_line, collector.paths, of_whole);
  const std::size_t next_line = collector.end();
  for (const LocatedFinding& located : of_whole) {
    if (has_all || located.line < next_line) {
      collector.take(located);
    } else {
      collector.count(located.finding.id);
    }
  }
  put_in_order(excerpt.report, collector.paths, jumps);
  return excerpt;
}

}  // namespace isocnc::check
