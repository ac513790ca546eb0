#include "analyzer/analysis.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

namespace isocnc::analyzer {

/// Chunks that are checked before somebody is asked whether to go on: a millisecond or so.
static constexpr std::size_t kChunksAtOnce = 64;

Analysis::Analysis(const syntax::Document& document, const execution::Setup& setup)
    : Analysis(document, setup, Unchecked{}) {
  update();
}

Analysis::Analysis(const syntax::Document& document, const execution::Setup& setup, Unchecked)
    : document_(document), setup_(setup) {}

Frontier Analysis::before(std::size_t chunk) const {
  if (chunk == rows_.size()) return end_;
  Frontier frontier = rows_[chunk].checked->before;
  rows_[chunk].shift.apply(frontier);
  return frontier;
}

// --- Jumps

/// What in a chunk concerns jumps; of labels those alone that some jump names.
std::vector<JumpEvent> Analysis::read_jumps(std::size_t chunk, syntax::ChunkTrees& trees) const {
  std::vector<JumpEvent> events;
  const std::string_view text = document_.chunk_text(chunk);
  if (!may_hold_jumps(text) && (jumps_.empty() || !may_hold_labels(text))) return events;
  trees.read(document_, chunk);
  for (std::size_t i = 0; i < trees.size(); ++i) {
    const syntax::LineTree line = trees[i];
    if (line.plain_arguments != 0 && !(line.has_label() && jumps_.names(line.label))) continue;
    each_event(line, [&](JumpEvent event) {
      if (event.kind == JumpEvent::Kind::Label && !jumps_.names(event.label)) return;
      event.line = static_cast<std::uint32_t>(i);
      events.push_back(event);
    });
  }
  events.shrink_to_fit();
  return events;
}

/// Finds the labels that these jumps name, which are not those that were named before.
void Analysis::read_labels(const JumpMap& jumps) {
  syntax::ChunkTrees trees;
  for (std::size_t chunk = 0; chunk < rows_.size(); ++chunk) {
    std::vector<JumpEvent>& events = rows_[chunk].jumps;
    std::erase_if(events, [](const JumpEvent& event) { return event.kind == JumpEvent::Kind::Label; });
    const auto others = static_cast<std::ptrdiff_t>(events.size());
    if (jumps.empty() || !may_hold_labels(document_.chunk_text(chunk))) continue;
    trees.read(document_, chunk);
    for (std::size_t i = 0; i < trees.size(); ++i) {
      const syntax::LineTree line = trees[i];
      if (line.has_label() && jumps.names(line.label))
        events.push_back({.kind = JumpEvent::Kind::Label, .line = static_cast<std::uint32_t>(i), .label = line.label});
    }
    // A line's label counts before what else is on the line.
    std::inplace_merge(
        events.begin(), events.begin() + others, events.end(), [](const JumpEvent& a, const JumpEvent& b) {
          const auto rank = [](const JumpEvent& event) { return event.kind == JumpEvent::Kind::Label ? 0 : 1; };
          return a.line != b.line ? a.line < b.line : rank(a) < rank(b);
        });
  }
}

/// The jumps of the program, from what is known of its chunks.
JumpMap Analysis::find_jumps() {
  JumpMap jumps;
  const auto each = [&](JumpEvent::Kind kind, auto take) {
    for (std::size_t chunk = 0; chunk < rows_.size(); ++chunk)
      for (const JumpEvent& event : rows_[chunk].jumps)
        if (event.kind == kind) take(document_.first_line_of_chunk(chunk) + event.line, event);
  };
  each(JumpEvent::Kind::Jump, [&](std::uint64_t line, const JumpEvent& event) { jumps.add(line, event.jump); });
  if (!jumps.names_the_same(jumps_)) read_labels(jumps);
  if (jumps.compares_registers())
    for (std::size_t chunk = 0; chunk < rows_.size(); ++chunk)
      for (const JumpEvent& event : rows_[chunk].jumps) jumps.note_registers(event.kind, event.reg, event.label);
  jumps.complete();
  if (jumps.empty()) return jumps;
  std::unordered_map<std::uint64_t, std::vector<std::uint64_t>> labels;
  each(JumpEvent::Kind::Label,
       [&](std::uint64_t line, const JumpEvent& event) { labels[event.label].push_back(line); });
  jumps.resolve(labels);
  return jumps;
}

/// Tells the jumps where they stand now.
void Analysis::move_jumps() {
  std::uint32_t jump = 0;
  for (std::size_t chunk = 0; chunk < rows_.size(); ++chunk)
    for (const JumpEvent& event : rows_[chunk].jumps)
      if (event.kind == JumpEvent::Kind::Jump)
        jumps_.move_jump(jump++, document_.first_line_of_chunk(chunk) + event.line, event.jump);
}

/// Brings the jumps up to date where some events have been replaced by others. False when they mean something else now.
bool Analysis::follow_jumps(const std::vector<JumpEvent>& old_events, const std::vector<JumpEvent>& new_events) {
  const bool same = std::equal(old_events.begin(), old_events.end(), new_events.begin(), new_events.end(),
                               [](const JumpEvent& a, const JumpEvent& b) { return a.means_the_same(b); });
  if (same) {
    if (!jumps_.empty()) move_jumps();
    return true;
  }
  JumpMap jumps = find_jumps();
  const bool stand = jumps.means_the_same(jumps_);
  jumps_ = std::move(jumps);
  return stand;
}

// --- Check

static void append(std::vector<JumpEvent>& all, const std::vector<JumpEvent>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

bool Analysis::update(const std::function<bool()>& stop) {
  lines_checked_ = 0;
  const bool is_first = rows_.size() == 0;
  const auto change = rows_.change_to(document_);
  Frontier at_change = is_first ? Frontier{} : before(change.first);
  std::vector<JumpEvent> old_events;
  std::vector<JumpEvent> new_events;
  for (std::size_t i = change.first; i < change.first + change.removed; ++i) {
    append(old_events, rows_[i].jumps);
    finding_count_ -= rows_[i].checked->outcome.findings.size();
  }
  const bool has_changed = change.removed + change.inserted > 0;
  syntax::ChunkTrees trees;
  rows_.follow(document_, change, [&](std::size_t chunk) {
    Row fresh;
    fresh.jumps = read_jumps(chunk, trees);
    append(new_events, fresh.jumps);
    return fresh;
  });
  const bool jumps_stand = !has_changed || follow_jumps(old_events, new_events);
  if (is_first || !jumps_stand) {
    // Frontiers name jumps by number and compare registers by cells: with other jumps all of them mean something else.
    for (std::size_t i = 0; i < rows_.size(); ++i) rows_[i].is_stale = true;
    return check_from(0, Checker::start(setup_), stop);
  }
  if (has_changed && !check_from(change.first, std::move(at_change), stop)) return false;
  for (std::size_t i = 0; i < rows_.size(); ++i)
    if (rows_[i].is_stale && !check_from(i, before(i), stop)) return false;
  return true;
}

/// Goes on from a chunk, as long as there is anything new. False when stopped, with the rest stale.
bool Analysis::check_from(std::size_t chunk, Frontier frontier, const std::function<bool()>& stop) {
  Checker checker(setup_, jumps_);
  checker.frontier = std::move(frontier);
  syntax::ChunkTrees trees;
  for (std::size_t checked = 1; chunk < rows_.size(); ++chunk) {
    if (!rows_[chunk].is_stale) {
      auto shift = shift_between(before(chunk), checker.frontier);
      if (shift) {
        chunk = pass_over(chunk, *shift);
        if (shift->empty()) return true;
        checker.frontier = before(chunk);
        shift->apply(checker.frontier);
        if (chunk == rows_.size()) break;
      }
    }
    if (stop && checked++ % kChunksAtOnce == 0 && stop()) {
      rows_[chunk].checked->before = std::move(checker.frontier);
      rows_[chunk].shift = {};
      rows_[chunk].is_stale = true;
      return false;
    }
    trees.read(document_, chunk);
    check_chunk(chunk, trees, checker);
  }
  end_ = std::move(checker.frontier);
  return true;
}

/// Shifts chunks from this one on, as long as they do not mind. Returns the first that does, with what is left of the
/// shift before it.
std::size_t Analysis::pass_over(std::size_t chunk, PositionShift& shift) {
  for (; chunk < rows_.size() && !shift.empty(); ++chunk) {
    Row& row = rows_[chunk];
    const PositionUse& use = row.positions;
    const bool minds =
        row.is_stale || use.far || (shift.axes & use.read) != 0 || (use.by_several && (shift.axes & use.set) != 0);
    if (minds || !row.shift.add(shift)) break;
    shift.drop(use.set);
  }
  return chunk;
}

void Analysis::check_chunk(std::size_t chunk, const syntax::ChunkTrees& trees, Checker& checker) {
  Row& row = rows_[chunk];
  Outcome outcome;
  Frontier before = checker.frontier;
  checker.check_all(trees, outcome);
  lines_checked_ += trees.size();
  finding_count_ += outcome.findings.size() - row.checked->outcome.findings.size();
  row.shift = {};
  row.positions = outcome.positions;
  row.is_stale = false;
  row.has_text = outcome.has_text;
  row.has_more =
      !outcome.findings.empty() || !outcome.labels.empty() || !outcome.live_jumps.empty() || outcome.assigned != 0;
  outcome.findings.shrink_to_fit();
  outcome.count();
  *row.checked = {std::move(before), std::move(outcome)};
}

FirstFindings Analysis::excerpt(const FirstFindingsWishes& wishes) const {
  std::size_t last_text = rows_.size();
  while (last_text > 0 && !rows_[last_text - 1].has_text) --last_text;
  std::vector<PlacedOutcome> outcomes;
  for (std::size_t i = 0; i < rows_.size(); ++i)
    if (rows_[i].has_more || i + 1 == last_text)
      outcomes.push_back({&rows_[i].checked->outcome, document_.first_line_of_chunk(i)});
  return conclude(
      outcomes, end_, jumps_,
      [&](std::uint64_t line) { return document_.text_of_line(static_cast<std::size_t>(line)); }, wishes);
}

std::vector<LocatedFinding> Analysis::findings_on(std::size_t line) const {
  const std::size_t chunk = document_.chunk_of_line(line);
  const std::size_t first_line = document_.first_line_of_chunk(chunk);
  std::vector<LocatedFinding> found;
  for (const LocatedFinding& located : rows_[chunk].checked->outcome.findings) {
    if (first_line + located.line != line) continue;
    found.push_back({line, located.finding});
  }
  return found;
}

Frontier Analysis::frontier_before(std::size_t line) const {
  line = std::min(line, document_.line_count());
  if (line == document_.line_count()) return end_;
  const std::size_t chunk = document_.chunk_of_line(line);
  Checker checker(setup_, jumps_);
  checker.frontier = before(chunk);
  Outcome ignored;
  syntax::ChunkTrees trees;
  trees.read(document_, chunk, line - document_.first_line_of_chunk(chunk));
  checker.check_all(trees, ignored);
  return checker.frontier;
}

}  // namespace isocnc::analyzer
