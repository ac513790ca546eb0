#include "analyzer/fixing/finding_fixes.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "interpreter/dialect/diagnostic_id.h"
#include "interpreter/text/unicode.h"

namespace isocnc::fixing {

using namespace dialect::literals;
using fixes::Edit;
using fixes::Fix;
using syntax::Position;

static std::size_t first_reduced_line(const check::Report& report) {
  for (const check::LocatedFinding& located : report.findings)
    if (located.finding.id == "too-many-paths"_diag) return located.line;
  return std::numeric_limits<std::size_t>::max();
}

std::optional<Fix> fix_of_all_lines(const check::LocatedFinding& located, const check::Report& report,
                                    bool on_every_path, fixes::FixProgram& program, std::size_t max_lines) {
  std::optional<Fix> fix = fixes::fix_of({located.line, located.finding, on_every_path}, program);
  const std::span<const check::Repetition> repetitions = report.repetitions_of(located);
  if (!fix || fix->mends_repetitions || repetitions.size() >= max_lines) return fix;
  for (const check::Repetition& again : repetitions) {
    const syntax::Finding finding = again.finding();
    const std::optional<Fix> other = fixes::fix_of({again.line, finding, on_every_path}, program);
    if (!other || other->edits.front().begin < fix->edits.back().end) continue;
    fix->edits.insert(fix->edits.end(), other->edits.begin(), other->edits.end());
    ++fix->more_lines;
  }
  return fix;
}

FindingFixes::FindingFixes(std::string_view text, const check::Report& report, const rules::CheckSetup& setup)
    : program_(text, setup), report_(report), setup_(setup), reduced_from_(first_reduced_line(report)) {}

std::optional<Fix> FindingFixes::of(const check::LocatedFinding& located, std::size_t max_lines) {
  const bool on_every_path = located.path < 0 && located.line < reduced_from_;
  return fix_of_all_lines(located, report_, on_every_path, program_, max_lines);
}

std::optional<Fix> FindingFixes::offered(const check::LocatedFinding& located, std::size_t max_lines) {
  std::optional<Fix> fix = of(located, max_lines);
  if (!fix) return fix;
  if (!trial_) trial_.emplace(program_, setup_, program_.jumps());
  const bool improves = fix->habit == fixes::Habit::None
                            ? trial_->improves(*fix, located, program_.frontier_before(located.line))
                            : trial_->improves(fix->habit);
  if (!improves) fix.reset();
  return fix;
}

std::optional<Fix> FindingFixes::offered_in_full(const check::LocatedFinding& located) {
  std::optional<Fix> fix = offered(located, static_cast<std::size_t>(-1));
  if (!fix || fix->habit == fixes::Habit::None) return fix;
  if (std::exchange(given_in_full_[static_cast<std::size_t>(fix->habit)], true)) return std::nullopt;
  fix->edits = all_edits(*fix, program_);
  return fix;
}

std::size_t FindingFixes::column(const Position& position) {
  if (counted_columns_ == 0 || position.line != counted_line_ || position.column < counted_bytes_) {
    counted_line_ = position.line;
    counted_bytes_ = 0;
    counted_columns_ = 1;
  }
  const std::string_view passed = program_.text(position.line).substr(counted_bytes_, position.column - counted_bytes_);
  counted_columns_ += text::column_of(passed, passed.size()) - 1;
  counted_bytes_ = position.column;
  return counted_columns_;
}

std::vector<ShownEdit> FindingFixes::shown(const Fix& fix) {
  std::vector<ShownEdit> edits;
  for (const Edit& edit : fix.edits) {
    ShownEdit each{.line = edit.begin.line + 1, .column = column(edit.begin)};
    each.end_line = edit.end.line + 1;
    each.end_column = column(edit.end);
    each.text = edit.text_with(program_.line_end(edit.begin.line));
    edits.push_back(std::move(each));
  }
  return edits;
}

static bool stands_before(const Edit& a, const Edit& b) {
  return a.begin != b.begin ? a.begin < b.begin : a.end < b.end;
}

std::optional<std::string> FindingFixes::changed_line(const check::LocatedFinding& located, const Fix& fix) {
  const auto stays_on_line = [&](const Edit& edit) {
    return edit.begin.line == located.line && edit.end.line == located.line &&
           edit.text.find('\n') == std::string::npos;
  };
  if (!std::all_of(fix.edits.begin(), fix.edits.end(), stays_on_line)) return std::nullopt;
  std::vector<Edit> edits = fix.edits;
  std::sort(edits.begin(), edits.end(), stands_before);
  std::string line(program_.text(located.line));
  for (auto edit = edits.rbegin(); edit != edits.rend(); ++edit)
    line.replace(edit->begin.column, edit->end.column - edit->begin.column, edit->text);
  return line;
}

std::string edited(std::string_view text, std::vector<Edit>& edits, const TextProgram& program) {
  std::sort(edits.begin(), edits.end(), stands_before);
  std::string result;
  result.reserve(text.size() + 16 * edits.size());
  std::size_t copied = 0;
  for (const Edit& edit : edits) {
    const std::size_t begin = program.offset(edit.begin);
    result += text.substr(copied, begin - copied);
    result += edit.text_with(program.line_end(edit.begin.line));
    copied = program.offset(edit.end);
  }
  result += text.substr(copied);
  return result;
}

}  // namespace isocnc::fixing
