#include "analyzer/fixing/fix_trial.h"

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "analyzer/check/check_text.h"
#include "analyzer/check/conclusion.h"
#include "interpreter/dialect/diagnostic_id.h"

namespace isocnc::fixing {

using namespace dialect::literals;
using fixes::Edit;
using fixes::Fix;

/// The maximum number of lines from the finding to the last edit, and of lines examined below.
static constexpr std::size_t kMaxEdited = 6'000;
static constexpr std::size_t kMaxFollowed = 10'000;
/// The work budget for all trial fixes of a program, in executed lines times states; kWorkPerLine is added per line.
static constexpr std::size_t kMinWork = 400'000;
static constexpr std::size_t kWorkPerLine = 20;
/// Lines examined once the budget is used up: most possible damage shows near the edits.
static constexpr std::size_t kNearest = 8;
/// With at most this many lines left, a trial continues to the end of the program even if its checks agree again.
static constexpr std::size_t kMaxBlank = 8;

namespace {

bool finds(const std::vector<check::LocatedFinding>& findings, dialect::DiagnosticId id) {
  return std::any_of(findings.begin(), findings.end(),
                     [&](const check::LocatedFinding& located) { return located.finding.id == id; });
}

/// A check that continues from a frontier, and its findings.
class TrialCheck {
 public:
  TrialCheck(const rules::CheckSetup& setup, const check::JumpMap& jumps, const check::Frontier& from)
      : jumps_(jumps), checker_(setup, jumps) {
    checker_.frontier = from;
  }

  void check(const syntax::LineTree& tree) {
    checker_.check(tree, line_, outcome_);
    if (outcome_.has_text && outcome_.last_text_line == line_) last_text_ = tree.text;
    ++line_;
  }

  const check::Frontier& frontier() const { return checker_.frontier; }

  /// Adds the findings since the last call.
  void count(FindingDelta& delta, int times) {
    delta.count(outcome_.findings, counted_, times);
    counted_ = outcome_.findings.size();
  }
  const std::vector<check::LocatedFinding>& findings() const { return outcome_.findings; }

  /// All findings, with those that need the whole program, for a check that has reached its end.
  check::Report conclusion() {
    return check::conclude(std::move(outcome_), checker_.frontier, jumps_, [&](std::size_t) { return last_text_; });
  }

 private:
  const check::JumpMap& jumps_;
  check::Checker checker_;
  check::Outcome outcome_;
  std::size_t line_ = 0;
  std::size_t counted_ = 0;
  std::string_view last_text_;
};

/// Some consecutive lines of a program, with the edits applied.
std::string edited_lines(fixes::FixProgram& program, std::size_t first, std::size_t last, std::vector<Edit> edits) {
  std::string text;
  std::vector<std::size_t> starts;
  for (std::size_t line = first; line <= last; ++line) {
    starts.push_back(text.size());
    text += program.text(line);
    if (line < last) text += '\n';
  }
  const auto offset = [&](const syntax::Position& place) { return starts[place.line - first] + place.column; };
  const auto by_place = [](const Edit& a, const Edit& b) { return a.begin < b.begin; };
  std::stable_sort(edits.begin(), edits.end(), by_place);
  std::string edited;
  edited.reserve(text.size() + 16 * edits.size());
  std::size_t copied = 0;
  for (const Edit& edit : edits) {
    edited.append(text, copied, offset(edit.begin) - copied);
    edited += edit.text;
    copied = offset(edit.end);
  }
  edited.append(text, copied);
  return edited;
}

/// The lines of a text and their trees.
class TextLines {
 public:
  explicit TextLines(std::string_view text) {
    for (std::size_t end = 0; (end = text.find('\n')) != std::string_view::npos; text.remove_prefix(end + 1))
      append(text.substr(0, end));
    append(text);
  }
  std::size_t size() const { return starts_.size(); }
  syntax::LineTree operator[](std::size_t index) const { return store_.tree(index, starts_[index]); }

 private:
  void append(std::string_view line) {
    starts_.push_back(line.data());
    store_.append_line(line.data(), line.data() + line.size());
  }

  std::vector<const char*> starts_;
  syntax::TreeStore store_;
};

}  // namespace

/// The checks of the program without and with a fix.
struct FixTrial::TrialComparison {
  TrialCheck without;
  TrialCheck with;
  FindingDelta delta = {};

  const FindingDelta& so_far() {
    with.count(delta, 1);
    without.count(delta, -1);
    return delta;
  }
  bool has_met() const { return without.frontier() == with.frontier(); }
};

/// Whether no code enabled by default is found more often, and the finding's own code, if it was found, less often.
static bool is_better(const FindingDelta& delta, bool found_own, const check::LocatedFinding& located) {
  for (std::size_t i = 0; i < dialect::kDiagnosticCount; ++i) {
    const dialect::DiagnosticId id{static_cast<std::uint8_t>(i)};
    if (delta.of(id) > 0 && !dialect::definition(id).is_off) return false;
  }
  return !found_own || delta.of(located.finding.id) < 0;
}

FixTrial::FixTrial(fixes::FixProgram& program, const rules::CheckSetup& setup, const check::JumpMap& jumps)
    : program_(program),
      setup_(setup),
      jumps_(jumps),
      lines_(program),
      work_budget_(kMinWork + kWorkPerLine * program.line_count()) {}

/// The jump map depends on the number of each jump and the place of each label, so editing one affects all lines.
bool FixTrial::is_affected_by_jumps(const syntax::LineTree& line) const {
  return line.jump != nullptr || (line.has_label() && jumps_.names(line.label));
}

std::optional<check::Report> FixTrial::found_with(std::vector<Edit> edits) {
  const std::size_t lines = program_.line_count();
  if (work_budget_ < lines) return std::nullopt;
  work_budget_ -= lines;
  return check::check_text(edited_lines(program_, 0, lines - 1, std::move(edits)), setup_);
}

const check::Report* FixTrial::findings_of_whole() {
  if (!findings_of_whole_) findings_of_whole_ = found_with({});
  return findings_of_whole_ ? &*findings_of_whole_ : nullptr;
}

bool FixTrial::improves_whole_program(const Fix& fix, const check::LocatedFinding& located) {
  const check::Report* const before = findings_of_whole();
  const std::optional<check::Report> after = before ? found_with(fix.edits) : std::nullopt;
  if (!after) return true;
  FindingDelta delta;
  delta.count(*after, 1);
  delta.count(*before, -1);
  return is_better(delta, finds(before->findings, located.finding.id), located);
}

/// The codes that a habit causes.
static std::span<const dialect::DiagnosticId> codes_of(fixes::Habit habit) {
  static constexpr dialect::DiagnosticId kCenters[] = {
      "arc-center-mismatch"_diag,       "arc-radius-mismatch"_diag,       "center-undetermined-g17-i"_diag,
      "center-undetermined-g17-j"_diag, "center-undetermined-g18-i"_diag, "center-undetermined-g18-k"_diag,
      "center-undetermined-g19-j"_diag, "center-undetermined-g19-k"_diag, "arc-barely-fits"_diag,
      "center-legal-both-ways"_diag};
  static constexpr dialect::DiagnosticId kUnits[] = {"unsupported-g"_diag};
  static constexpr dialect::DiagnosticId kMilliseconds[] = {"dwell-of-odd-length"_diag};
  switch (habit) {
    case fixes::Habit::None:
      break;
    case fixes::Habit::CentersInG90:
    case fixes::Habit::CentersInG91:
      return kCenters;
    case fixes::Habit::ForeignUnits:
      return kUnits;
    case fixes::Habit::Milliseconds:
      return kMilliseconds;
  }
  return {};
}

/// Codes whose findings depend on how lengths, centers or modes are read: positions, speeds, and repeated words.
static constexpr dialect::DiagnosticId kJudgedByReading[] = {"redundant-modal"_diag,
                                                             "arc-radius-mismatch"_diag,
                                                             "arc-radius-too-small"_diag,
                                                             "arc-center-mismatch"_diag,
                                                             "center-undetermined-g17-i"_diag,
                                                             "center-undetermined-g17-j"_diag,
                                                             "center-undetermined-g18-i"_diag,
                                                             "center-undetermined-g18-k"_diag,
                                                             "center-undetermined-g19-j"_diag,
                                                             "center-undetermined-g19-k"_diag,
                                                             "arc-barely-fits"_diag,
                                                             "center-legal-both-ways"_diag,
                                                             "arc-goes-nowhere"_diag,
                                                             "motion-goes-nowhere"_diag,
                                                             "travel-exceeded"_diag,
                                                             "feed-above-machine"_diag,
                                                             "rotary-speed-above-machine"_diag,
                                                             "rapid-below-clearance"_diag,
                                                             "dwell-of-odd-length"_diag,
                                                             "end-in-inches"_diag,
                                                             "useless-suppression"_diag};

bool reads_better(const check::Report& before, const check::Report& after, fixes::Habit habit) {
  FindingDelta delta;
  delta.count(after, 1);
  delta.count(before, -1);
  int of_habit = 0;
  for (const dialect::DiagnosticId id : codes_of(habit)) of_habit += delta.of(id);
  for (std::size_t i = 0; i < dialect::kDiagnosticCount; ++i) {
    const dialect::DiagnosticId id{static_cast<std::uint8_t>(i)};
    const bool is_judged_by_reading =
        std::find(std::begin(kJudgedByReading), std::end(kJudgedByReading), id) != std::end(kJudgedByReading);
    if (delta.of(id) > 0 && !is_judged_by_reading && !dialect::definition(id).is_off) return false;
  }
  return of_habit < 0;
}

bool FixTrial::improves(fixes::Habit habit) {
  std::optional<bool>& known = improving_habits_[static_cast<std::size_t>(habit)];
  if (known) return *known;
  const check::Report* const before = findings_of_whole();
  const std::optional<check::Report> after = before ? found_with(all_edits({.habit = habit}, program_)) : std::nullopt;
  known = !after || reads_better(*before, *after, habit);
  return *known;
}

bool FixTrial::improves(const Fix& fix, const check::LocatedFinding& located, const check::Frontier& before) {
  const std::size_t first = located.line;
  std::size_t last = first;
  for (const Edit& edit : fix.edits) {
    if (edit.begin.line < first) return improves_whole_program(fix, located);
    last = std::max(last, edit.end.line);
  }
  if (last - first > (work_budget_ > 0 ? kMaxEdited : kNearest)) return true;

  const std::string text = edited_lines(program_, first, last, fix.edits);
  const TextLines edited(text);
  for (std::size_t i = 0; i < edited.size(); ++i)
    if (is_affected_by_jumps(edited[i])) return improves_whole_program(fix, located);
  TrialComparison compared{.without = {setup_, jumps_, before}, .with = {setup_, jumps_, before}};
  for (std::size_t line = first; line <= last; ++line) {
    const syntax::LineTree tree = lines_[line];
    if (is_affected_by_jumps(tree)) return improves_whole_program(fix, located);
    compared.without.check(tree);
    spend(compared.without.frontier());
  }
  for (std::size_t i = 0; i < edited.size(); ++i) {
    compared.with.check(edited[i]);
    spend(compared.with.frontier());
  }
  return follow(compared, last + 1, located);
}

void FixTrial::spend(const check::Frontier& frontier) {
  work_budget_ -= std::min<std::size_t>(work_budget_, 1 + frontier.live.size());
}

bool FixTrial::follow(TrialComparison& compared, std::size_t next, const check::LocatedFinding& located) {
  const std::size_t end = program_.line_count();
  const std::size_t nearest = next + kNearest;
  const std::size_t farthest = std::min(end, next + kMaxFollowed);
  const auto is_near_end = [&] { return end - next <= kMaxBlank; };
  Trail trail;
  std::optional<Trail::TrailRest> rest;
  while (next < farthest && (work_budget_ > 0 || next < nearest) && (!compared.has_met() || is_near_end())) {
    rest = trails_.rest_from(next, compared.with.frontier());
    if (rest) break;
    trail.pass(next, compared.with.frontier(), compared.so_far());
    const syntax::LineTree tree = lines_[next++];
    compared.without.check(tree);
    compared.with.check(tree);
    spend(compared.with.frontier());
  }
  const FindingDelta so_far = compared.so_far();
  bool found_own = finds(compared.without.findings(), located.finding.id);
  if (!rest) {
    rest = Trail::TrailRest{.next_line = next, .has_more = next < end && !compared.has_met()};
    if (next == end) {
      rest->delta.count(compared.with.conclusion(), 1);
      const check::Report found = compared.without.conclusion();
      rest->delta.count(found, -1);
      rest->delta -= so_far;
      found_own |= finds(found.findings, located.finding.id);
    }
  }
  FindingDelta in_all = so_far;
  in_all += rest->delta;
  if (trail.is_long()) {
    trail.end(so_far, *rest);
    trails_.keep(std::move(trail));
  }
  return is_better(in_all, found_own, located);
}

}  // namespace isocnc::fixing
