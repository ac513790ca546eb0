#include "lsp/documents/analyzed_document.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

#include "analyzer/check/folding.h"
#include "analyzer/selection/run_report.h"
#include "analyzer/selection/shown_report.h"
#include "analyzer/selection/style_findings.h"
#include "interpreter/system/source_file.h"
#include "lsp/protocol/uri.h"

namespace isocnc::documents {

AnalyzedDocument::AnalyzedDocument(std::string uri, SettingsStore& settings) : uri_(std::move(uri)), store_(settings) {}

/// The lines of a document that are the same in another one, from the top and, below those, from the end.
static std::pair<std::size_t, std::size_t> equal_lines(const syntax::Document& a, const syntax::Document& b) {
  const std::size_t max = std::min(a.line_count(), b.line_count());
  std::size_t top = 0;
  while (top < max && a.text_of_line(top) == b.text_of_line(top)) ++top;
  std::size_t end = 0;
  while (end < max - top && a.text_of_line(a.line_count() - 1 - end) == b.text_of_line(b.line_count() - 1 - end)) ++end;
  return {top, end};
}

/// Replaces the text of a document that stays open.
void AnalyzedDocument::replace_all(std::int64_t version, std::string_view text) {
  const syntax::Document before = std::exchange(document_, syntax::Document());
  open(version, text);
  if (!run_) return;
  const auto [top, end] = equal_lines(before, document_);
  run_->replace_lines(top, before.line_count() - top - end, document_.line_count() - top - end);
  run_->expire();
}

void AnalyzedDocument::open(std::int64_t version, std::string_view text) {
  version_ = version;
  has_byte_order_mark_ = text.starts_with(system::kByteOrderMark);
  if (has_byte_order_mark_) text.remove_prefix(system::kByteOrderMark.size());
  settings_ = store_.of(protocol::path_of(uri_));
  analysis_.reset();
  index_ = {};
  has_suppressions_ = {};
  report_.reset();
  memories_.clear();  // The new text numbers its chunks anew.
  document_ = syntax::Document(text);
  is_up_to_date_ = false;
  ++revision_;
}

void AnalyzedDocument::edit(std::int64_t version, const std::vector<ContentChange>& changes,
                            protocol::Encoding encoding) {
  for (const ContentChange& change : changes) {
    if (change.range) {
      replace(change, encoding);
    } else {
      replace_all(version, change.text);
    }
  }
  version_ = version;
  is_up_to_date_ = false;
  ++revision_;
}

void AnalyzedDocument::replace(const ContentChange& change, protocol::Encoding encoding) {
  protocol::ClientPosition first = change.range->start;
  protocol::ClientPosition last = change.range->end;
  if (last < first) std::swap(first, last);
  const auto last_line = static_cast<std::uint32_t>(document_.line_count() - 1);
  if (first.line > last_line) first = {last_line, std::numeric_limits<std::uint32_t>::max()};
  const std::size_t first_line = first.line;
  const std::size_t end_line = std::min(last.line, last_line);
  const std::size_t line_count = document_.line_count();
  const std::string first_text(run_ ? document_.text_of_line(first_line) : "");
  const std::string end_text(run_ ? document_.text_of_line(end_line) : "");
  // The client counts the mark as a character.
  if (first.line == 0 && std::exchange(has_byte_order_mark_, false)) document_.replace({}, {}, system::kByteOrderMark);
  document_.replace(from_client(first, encoding), from_client(last, encoding), change.text);
  if (first.line == 0 && document_.text_of_line(0).starts_with(system::kByteOrderMark)) {
    has_byte_order_mark_ = true;
    document_.replace({}, {0, system::kByteOrderMark.size()}, {});
  }
  if (run_) move_run({first_line, first_text}, {end_line, end_text}, line_count);
}

/// Moves the kept run along with the lines after an edit from `first` to `last`, of a text that had so many lines.
void AnalyzedDocument::move_run(const OldLine& first, const OldLine& last, std::size_t line_count) {
  std::size_t begin = first.line;
  std::size_t old_end = last.line + 1;
  std::size_t new_end = old_end + document_.line_count() - line_count;
  if (document_.text_of_line(begin) == first.text) ++begin;
  if (begin < std::min(old_end, new_end) && document_.text_of_line(new_end - 1) == last.text) {
    --old_end;
    --new_end;
  }
  run_->replace_lines(begin, old_end - begin, new_end - begin);
  run_->expire();
}

void AnalyzedDocument::take_run(simulation::RunOutcome outcome) {
  run_.emplace(std::move(outcome));
  report_.reset();
}

/// Of lines with cuts, the first that is not above `line`.
static auto first_removed_from(std::size_t line, const std::vector<simulation::RemovedOnLine>& removed) {
  return std::partition_point(removed.begin(), removed.end(),
                              [&](const simulation::RemovedOnLine& each) { return each.line < line; });
}

std::optional<simulation::RemovedOnLine> AnalyzedDocument::removed_on(std::size_t line) const {
  if (!run_ || !run_->is_current()) return std::nullopt;
  const auto found = first_removed_from(line, run_->outcome().removed);
  return found != run_->outcome().removed.end() && found->line == line ? std::optional(*found) : std::nullopt;
}

std::optional<double> AnalyzedDocument::removed_between(std::size_t first, std::size_t end) const {
  if (!run_ || !run_->is_current() || !run_->outcome().has_stock) return std::nullopt;
  const std::vector<simulation::RemovedOnLine>& removed = run_->outcome().removed;
  double volume = 0;
  for (auto each = first_removed_from(first, removed); each != removed.end() && each->line < end; ++each)
    volume += each->volume;
  return volume;
}

void AnalyzedDocument::drop_run() {
  run_.reset();
  report_.reset();
}

std::size_t AnalyzedDocument::size() const {
  std::size_t bytes = 0;
  for (std::size_t chunk = 0; chunk < document_.chunk_count(); ++chunk) bytes += document_.chunk_text(chunk).size();
  return bytes;
}

void AnalyzedDocument::reread_settings() {
  DocumentSettings settings = store_.of(protocol::path_of(uri_));
  if (settings.program == settings_.program) return;
  settings_ = std::move(settings);
  analysis_.reset();
  report_.reset();
  is_up_to_date_ = false;
  ++revision_;
  if (run_) run_->expire();
}

check::Analysis& AnalyzedDocument::begun_analysis() {
  report_.reset();
  if (!analysis_) analysis_.emplace(document_, settings_.program->setup, check::Analysis::Unchecked{});
  return *analysis_;
}

bool AnalyzedDocument::update(const std::function<bool()>& stop) {
  if (is_up_to_date_) return true;
  is_up_to_date_ = begun_analysis().update(stop);
  return is_up_to_date_;
}

bool AnalyzedDocument::update_before(std::size_t line, const std::function<bool()>& stop) {
  return is_up_to_date_ || begun_analysis().update_before(line, stop);
}

const ProgramIndex& AnalyzedDocument::index() {
  index_.update(document_);
  return index_;
}

/// The suppressions in the program's comments.
selection::Suppressions AnalyzedDocument::read_suppressions() {
  has_suppressions_.update(document_, [&](std::size_t chunk) {
    return selection::Suppressions::may_have_directives(document_.chunk_text(chunk));
  });
  selection::Suppressions suppressions;
  for (std::size_t chunk = 0; chunk < has_suppressions_.size(); ++chunk) {
    const std::size_t first = document_.first_line_of_chunk(chunk);
    for (std::size_t line = first; has_suppressions_[chunk] && line < first + document_.chunk_lines(chunk); ++line)
      suppressions.read_line(line, document_.text_of_line(line));
  }
  return suppressions;
}

/// The report as isolint would show it, with --verify once there is a run.
check::Report AnalyzedDocument::shown_report() {
  if (run_) {
    // Without all that the run has found, a comment may only seem to have no effect.
    const bool is_whole = run_->is_current() && run_->outcome().findings.size() < KeptRun::kMaxFindings;
    return selection::shown_report_with_run(analysis_->report(), run_->outcome(), is_whole, document_,
                                            read_suppressions(), settings_.program->selection);
  }
  return selection::shown_report(analysis_->report(), document_, read_suppressions(), settings_.program->selection);
}

const check::Report& AnalyzedDocument::report() {
  if (!report_) report_ = shown_report();
  return *report_;
}

/// The number of findings up to which making the whole report takes no noticeable time.
static constexpr std::size_t kFewFindings = 4'000;

/// Whether the report has so many findings that it is made as a whole only on request. False if suppressions or style
/// rules affect it.
bool AnalyzedDocument::is_long() {
  return !report_ && analysis_->finding_count() > kFewFindings && !selection::has_style(settings_.program->selection) &&
         read_suppressions().empty();
}

/// The findings of a report that only a run shows, or the others.
static check::Report part_of(check::Report report, bool is_of_run) {
  std::erase_if(report.findings, [&](const auto& located) { return located.is_of_run != is_of_run; });
  return report;
}

check::FirstFindings AnalyzedDocument::excerpt(std::size_t maximum) {
  if (!is_long()) return {part_of(report(), false), 0};
  const selection::Selection& selection = settings_.program->selection;
  check::FirstFindings first = analysis_->excerpt(
      {.max = maximum, .severity = [&](dialect::DiagnosticId id) { return selection.severity(id); }, .folds = true});
  first.report = selection.shown(std::move(first.report));
  if (run_) first.report = selection::without_tips(std::move(first.report), run_->outcome(), selection);
  return first;
}

check::FirstFindings AnalyzedDocument::run_excerpt() {
  if (!run_) return {};
  if (!is_long()) return {part_of(report(), true), run_->left_out()};
  const selection::Selection& selection = settings_.program->selection;
  simulation::RunOutcome found = run_->outcome();
  std::erase_if(found.findings, [&](const simulation::RunFinding& each) { return is_known(each); });
  return {check::folded(selection.shown(selection::with_run({}, found))), run_->left_out()};
}

/// Whether the check of the text has found the same on that line.
bool AnalyzedDocument::is_known(const simulation::RunFinding& of_run) const {
  if (dialect::definition(of_run.finding.id).is_reported_by_runs()) return false;
  const std::vector<check::LocatedFinding> known = analysis_->findings_on(of_run.line);
  return std::any_of(known.begin(), known.end(),
                     [&](const check::LocatedFinding& located) { return located.finding.id == of_run.finding.id; });
}

std::vector<check::LocatedFinding> AnalyzedDocument::findings_on(std::size_t line) {
  if (is_long())
    return settings_.program->selection.shown({.findings = analysis_->findings_on(line), .paths = {}}).findings;
  const auto [begin, end] = std::equal_range(
      report().findings.begin(), report().findings.end(), check::LocatedFinding{.line = line, .finding = {}},
      [](const check::LocatedFinding& a, const check::LocatedFinding& b) { return a.line < b.line; });
  std::vector<check::LocatedFinding> found(begin, end);
  for (const check::LocatedFinding& located : report().findings) {
    const check::Repetition* const again = check::repetition_from(line, located, report());
    if (again && again->line == line) found.push_back({line, again->finding(), located.path});
  }
  return found;
}

protocol::ClientPosition AnalyzedDocument::to_client(const syntax::Position& position,
                                                     protocol::Encoding encoding) const {
  const std::string_view line = document_.text_of_line(position.line);
  std::uint32_t column = protocol::units_before(line, position.column, encoding);
  if (has_byte_order_mark_ && position.line == 0) column += protocol::units_before(system::kByteOrderMark, 3, encoding);
  return {static_cast<std::uint32_t>(position.line), column};
}

syntax::Position AnalyzedDocument::from_client(const protocol::ClientPosition& position,
                                               protocol::Encoding encoding) const {
  if (position.line >= document_.line_count()) {
    const std::size_t last = document_.line_count() - 1;
    return {last, document_.text_of_line(last).size()};
  }
  std::uint32_t column = position.character;
  if (has_byte_order_mark_ && position.line == 0)
    column -= std::min(column, protocol::units_before(system::kByteOrderMark, 3, encoding));
  return {position.line, protocol::byte_at(document_.text_of_line(position.line), column, encoding)};
}

}  // namespace isocnc::documents
