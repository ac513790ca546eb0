#include "analyzer/fix_trial.h"

#include <algorithm>
#include <string>
#include <vector>

#include "analyzer/check_text.h"
#include "interpreter/syntax/tree_store.h"

namespace isocnc::analyzer {

using fixes::Edit;
using fixes::Fix;

/// Lines of the finding and its edits, and lines below them.
static constexpr std::uint64_t kMostEdited = 6'000;
static constexpr std::uint64_t kFarthest = 10'000;
/// Lines, times the states in which each is executed, for all fixes of a program.
static constexpr std::uint64_t kMostWork = 400'000;
/// Lines below the edits that are looked over for whether the program ends there.
static constexpr std::uint64_t kMostBlank = 8;

namespace {

/// A check that goes on from somewhere, and what it finds.
class Attempt {
 public:
  Attempt(const execution::Setup& setup, const JumpMap& jumps, const Frontier& from)
      : jumps_(jumps), checker_(setup, jumps) {
    checker_.frontier = from;
  }

  void check(std::string_view text) {
    store_.clear();
    store_.append_line(text.data(), text.data() + text.size());
    checker_.check(store_.tree(0, text.data()), line_, outcome_);
    if (outcome_.has_text && outcome_.last_text_line == line_) last_text_ = text;
    ++line_;
  }

  const Frontier& frontier() const { return checker_.frontier; }

  /// What has been found; with what the end of the program shows where it has come there.
  Tally tally(bool at_end) && {
    Report report;
    if (at_end) {
      report = conclude(std::move(outcome_), checker_.frontier, jumps_, [&](std::uint64_t) { return last_text_; });
    } else {
      report.findings = std::move(outcome_.findings);
    }
    Tally tally;
    tally.add(report);
    return tally;
  }

 private:
  const JumpMap& jumps_;
  Checker checker_;
  Outcome outcome_;
  syntax::TreeStore store_;
  std::uint64_t line_ = 0;
  std::string_view last_text_;
};

/// Some lines of a program, one after the other, with the edits made.
std::string edited_lines(fixes::Program& program, std::uint64_t first, std::uint64_t last, std::vector<Edit> edits) {
  std::string text;
  std::vector<std::size_t> starts;
  for (std::uint64_t line = first; line <= last; ++line) {
    starts.push_back(text.size());
    text += program.text(line);
    if (line < last) text += '\n';
  }
  const auto offset = [&](const syntax::Position& place) { return starts[place.line - first] + place.column; };
  const auto by_place = [](const Edit& a, const Edit& b) { return a.begin < b.begin; };
  std::stable_sort(edits.begin(), edits.end(), by_place);
  for (auto edit = edits.rbegin(); edit != edits.rend(); ++edit)
    text.replace(offset(edit->begin), offset(edit->end) - offset(edit->begin), edit->text);
  return text;
}

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  for (std::size_t end = 0; (end = text.find('\n')) != std::string_view::npos; text.remove_prefix(end + 1))
    lines.push_back(text.substr(0, end));
  lines.push_back(text);
  return lines;
}

}  // namespace

/// Whether the finding is gone, and nothing that is told by default has come in its place.
static bool is_better(const Tally& left, const Tally& found, const LocatedFinding& located) {
  for (std::size_t i = 0; i < dialect::kDiagnosticCount; ++i) {
    const dialect::DiagnosticId id{static_cast<std::uint8_t>(i)};
    if (left.of(id) > found.of(id) && !dialect::definition(id).is_off) return false;
  }
  const dialect::DiagnosticId own = located.finding.id;
  return found.of(own) == 0 || left.of(own) < found.of(own);
}

FixTrial::FixTrial(fixes::Program& program, const execution::Setup& setup, const JumpMap& jumps)
    : program_(program), setup_(setup), jumps_(jumps), work_left_(kMostWork) {}

/// Jumps are known by their number in the program, and labels by where they stand.
bool FixTrial::is_concerned_by_jumps(std::string_view line) const {
  const syntax::ParsedLine parsed(line);
  const syntax::LineTree tree = parsed.tree();
  return tree.jump != nullptr || (tree.has_label() && jumps_.names(tree.label));
}

bool FixTrial::mends_in_whole(const Fix& fix, const LocatedFinding& located) {
  const std::uint64_t lines = program_.line_count();
  const auto tally_with = [&](std::vector<Edit> edits) {
    Tally tally;
    tally.add(check_text(edited_lines(program_, 0, lines - 1, std::move(edits)), setup_));
    work_left_ -= std::min(work_left_, lines);
    return tally;
  };
  if (work_left_ < (found_in_whole_ ? lines : 2 * lines)) return true;
  if (!found_in_whole_) found_in_whole_ = tally_with({});
  return is_better(tally_with(fix.edits), *found_in_whole_, located);
}

bool FixTrial::mends(const Fix& fix, const LocatedFinding& located, const Frontier& before) {
  const std::uint64_t first = located.line;
  std::uint64_t last = first;
  for (const Edit& edit : fix.edits) {
    if (edit.begin.line < first) return mends_in_whole(fix, located);
    last = std::max(last, edit.end.line);
  }
  if (last - first > kMostEdited || work_left_ == 0) return true;

  const auto concerned = [&](std::string_view line) { return is_concerned_by_jumps(line); };
  const std::string text = edited_lines(program_, first, last, fix.edits);
  const std::vector<std::string_view> edited = lines_of(text);
  if (std::any_of(edited.begin(), edited.end(), concerned)) return mends_in_whole(fix, located);
  Attempt without(setup_, jumps_, before);
  Attempt with(setup_, jumps_, before);
  const auto spend = [&](const Attempt& attempt) {
    work_left_ -= std::min<std::uint64_t>(work_left_, 1 + attempt.frontier().live.size());
  };
  for (std::uint64_t line = first; line <= last; ++line) {
    if (concerned(program_.text(line))) return mends_in_whole(fix, located);
    without.check(program_.text(line));
    spend(without);
  }
  for (const std::string_view line : edited) {
    with.check(line);
    spend(with);
  }

  std::uint64_t next = last + 1;
  const std::uint64_t end = program_.line_count();
  const auto is_near_end = [&] { return end - next <= kMostBlank; };
  while (next < end && next - last < kFarthest && work_left_ > 0 &&
         (without.frontier() != with.frontier() || is_near_end())) {
    without.check(program_.text(next));
    with.check(program_.text(next));
    spend(with);
    ++next;
  }
  return is_better(std::move(with).tally(next == end), std::move(without).tally(next == end), located);
}

}  // namespace isocnc::analyzer
