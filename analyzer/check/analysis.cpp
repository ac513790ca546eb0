#include "analyzer/check/analysis.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace isocnc::check {

Analysis::Analysis(const syntax::Document& document, const rules::CheckSetup& setup)
    : Analysis(document, setup, Unchecked{}) {
  update();
}

Analysis::Analysis(const syntax::Document& document, const rules::CheckSetup& setup, Unchecked)
    : document_(document), setup_(setup) {}

Frontier Analysis::before(std::size_t chunk) const {
  if (chunk == rows_.size()) return end_;
  Frontier frontier = rows_[chunk].checked->before;
  rows_[chunk].shift.apply(frontier);
  return frontier;
}

// --- Jumps

void Analysis::FlowEvents::push_back(const FlowEvent& event) {
  if (event.kind == FlowEvent::Kind::Assignment) {
    (places_.empty() ? assigned_first_ : places_.back().assigned) |= register_bit(event.reg);
    assignments_.push_back({event.value, event.line, event.reg});
    return;
  }
  const bool is_jump = event.kind == FlowEvent::Kind::Jump;
  places_.push_back({.label = is_jump ? event.jump.target : event.label,
                     .line = event.line,
                     .first_assignment = static_cast<std::uint32_t>(assignments_.size()),
                     .is_jump = is_jump});
  if (is_jump) jumps_.push_back(event.jump);
}

void Analysis::FlowEvents::shrink_to_fit() {
  places_.shrink_to_fit();
  assignments_.shrink_to_fit();
  jumps_.shrink_to_fit();
}

template <class IsGone>
bool Analysis::FlowEvents::erase_labels(IsGone is_gone) {
  // The assignments after a label then belong to the place before it.
  std::size_t kept = 0;
  for (const JumpOrLabel& place : places_) {
    if (place.is_jump || !is_gone(place.label)) {
      places_[kept++] = place;
    } else {
      (kept == 0 ? assigned_first_ : places_[kept - 1].assigned) |= place.assigned;
    }
  }
  const bool has_lost = kept < places_.size();
  places_.resize(kept);
  return has_lost;
}

template <class Take>
void Analysis::FlowEvents::each(Take take) const {
  std::size_t next = 0;
  const auto take_assignments = [&](std::size_t end) {
    for (; next < end; ++next)
      take(FlowEvent{.kind = FlowEvent::Kind::Assignment,
                     .reg = assignments_[next].reg,
                     .line = assignments_[next].line,
                     .value = assignments_[next].value});
  };
  auto jump = jumps_.begin();
  for (const JumpOrLabel& place : places_) {
    take_assignments(place.first_assignment);
    if (place.is_jump) {
      take(FlowEvent{.kind = FlowEvent::Kind::Jump, .line = place.line, .jump = *jump++});
    } else {
      take(FlowEvent{.kind = FlowEvent::Kind::Label, .line = place.line, .label = place.label});
    }
  }
  take_assignments(assignments_.size());
}

template <class TakeJump, class TakeAssignments>
void Analysis::FlowEvents::each_part(TakeJump jump, TakeAssignments assignments) const {
  std::size_t next = 0;
  RegisterSet assigned = assigned_first_;
  for (const JumpOrLabel& place : places_) {
    assignments(next, place.first_assignment, assigned);
    next = place.first_assignment;
    assigned = place.assigned;
    if (place.is_jump) jump();
  }
  assignments(next, assignments_.size(), assigned);
}

void Analysis::FlowEvents::collect(std::size_t first_line, JumpCollector& collector) const {
  auto jump = jumps_.begin();
  collector.add_assignments(assigned_first_);
  for (const JumpOrLabel& place : places_) {
    if (place.is_jump) {
      collector.add_jump(first_line + place.line, *jump++);
    } else {
      collector.add_label(place.label);
    }
    collector.add_assignments(place.assigned);
  }
}

Analysis::LabelRange Analysis::LabelRange::of(const syntax::ChunkTrees& trees) {
  LabelRange range;
  for (std::size_t line = 0; line < trees.size(); ++line) {
    const syntax::PlainLine plain = trees.store().plain(line);
    if (!plain.words.empty()) {
      if (plain.has_label) range.add(plain.label);
      continue;
    }
    const syntax::LineTree tree = trees[line];
    if (tree.has(syntax::LineTree::kTwoBlocks)) return any();
    if (tree.has_label()) range.add(tree.label);
  }
  return range;
}

/// Reads the events of a chunk that concern jumps, as far as the program has jumps.
void Analysis::read_jumps(std::size_t chunk, Row& row) const {
  const std::string_view text = document_.chunk_text(chunk);
  if (jumps_.empty() && !may_hold_jumps(text)) return;
  row.labels = {};
  each_event_in(text, [&](const FlowEvent& event) {
    const bool is_label = event.kind == FlowEvent::Kind::Label;
    if (is_label) row.labels.add(event.label);
    if (!is_label || jumps_.names(event.label)) row.jumps.push_back(event);
  });
  row.jumps.shrink_to_fit();
}

/// Reads the events of a chunk again, with the labels that jumps name now, if it may define some of those added.
/// Returns whether it defines any of them.
bool Analysis::read_labels(std::size_t chunk, const NamedLabels& change) {
  Row& row = rows_[chunk];
  const auto first = std::lower_bound(change.added.begin(), change.added.end(), row.labels.min);
  if (first == change.added.end() || *first > row.labels.max) return false;
  row.labels = {};
  row.jumps.clear();
  bool has_added = false;
  each_event_in(document_.chunk_text(chunk), [&](const FlowEvent& event) {
    const bool is_label = event.kind == FlowEvent::Kind::Label;
    if (is_label) row.labels.add(event.label);
    const bool is_added = is_label && std::binary_search(first, change.added.end(), event.label);
    if (is_label && !is_added && (!jumps_.names(event.label) || change.removes(event.label))) return;
    has_added |= is_added;
    row.jumps.push_back(event);
  });
  return has_added;
}

/// The labels that the jumps of these events name, ascending.
static std::vector<std::uint64_t> labels_named_by(const std::vector<FlowEvent>& events) {
  std::vector<std::uint64_t> labels;
  for (const FlowEvent& event : events)
    if (event.kind == FlowEvent::Kind::Jump) labels.push_back(event.jump.target);
  sort_once(labels);
  return labels;
}

/// The elements of `a` that are not in `b`; both are ascending.
static std::vector<std::uint64_t> difference(const std::vector<std::uint64_t>& a, const std::vector<std::uint64_t>& b) {
  std::vector<std::uint64_t> result;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
  return result;
}

bool Analysis::NamedLabels::removes(std::uint64_t label) const {
  return std::binary_search(removed.begin(), removed.end(), label);
}

/// The labels that jumps name after the old events have become the new ones, and did not name before, or the reverse.
Analysis::NamedLabels Analysis::named_labels(const std::vector<FlowEvent>& old_events,
                                             const std::vector<FlowEvent>& new_events) const {
  const std::vector<std::uint64_t> of_old = labels_named_by(old_events);
  const std::vector<std::uint64_t> of_new = labels_named_by(new_events);
  NamedLabels change{.added = difference(of_new, jumps_.labels()), .removed = difference(of_old, of_new)};
  if (change.removed.empty()) return change;
  // How often jumps elsewhere name a label that is no longer named here.
  std::vector<std::ptrdiff_t> others(change.removed.size());
  const auto count = [&](std::uint64_t label, std::ptrdiff_t by) {
    const auto found = std::lower_bound(change.removed.begin(), change.removed.end(), label);
    if (found != change.removed.end() && *found == label)
      others[static_cast<std::size_t>(found - change.removed.begin())] += by;
  };
  for (const JumpMap::Site& site : jumps_.sites()) count(site.jump.target, 1);
  for (const FlowEvent& event : old_events)
    if (event.kind == FlowEvent::Kind::Jump) count(event.jump.target, -1);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < others.size(); ++i)
    if (others[i] == 0) change.removed[kept++] = change.removed[i];
  change.removed.resize(kept);
  return change;
}

/// Reads the labels that jumps name now and did not name before, and forgets the others.
void Analysis::follow_labels(const NamedLabels& change) {
  if (change.added.empty() && change.removed.empty()) return;
  const auto is_removed = [&](std::uint64_t label) { return change.removes(label); };
  for (std::size_t chunk = 0; chunk < rows_.size(); ++chunk) {
    const bool has_lost = !change.removed.empty() && rows_[chunk].jumps.erase_labels(is_removed);
    if (read_labels(chunk, change) || has_lost) rows_[chunk].is_stale = true;
  }
}

/// The jumps of the program, from the events of its chunks, of which the old ones have become the new ones.
JumpMap Analysis::find_jumps(const std::vector<FlowEvent>& old_events, const std::vector<FlowEvent>& new_events) {
  follow_labels(named_labels(old_events, new_events));
  JumpCollector collector(jumps_);
  for (std::size_t chunk = 0; chunk < rows_.size(); ++chunk)
    rows_[chunk].jumps.collect(document_.first_line_of_chunk(chunk), collector);
  return std::move(collector).finish();
}

/// Updates the lines of jumps that are otherwise equivalent to the old ones.
void Analysis::move_jumps(const syntax::ChunkChange& change) {
  std::vector<JumpMap::Site> sites;
  for (std::size_t chunk = change.first; chunk < change.first + change.inserted; ++chunk)
    rows_[chunk].jumps.each([&](const FlowEvent& event) {
      if (event.kind == FlowEvent::Kind::Jump)
        sites.push_back({document_.first_line_of_chunk(chunk) + event.line, event.jump});
    });
  const std::size_t first_line =
      change.first < rows_.size() ? document_.first_line_of_chunk(change.first) : document_.line_count();
  const std::size_t first = jumps_.first_from(first_line);
  jumps_ = std::move(jumps_).moved(
      first, sites, static_cast<std::int64_t>(document_.line_count()) - static_cast<std::int64_t>(line_count_));
}

/// The jumps of these events, in order.
static std::vector<syntax::Jump> jumps_of(const std::vector<FlowEvent>& events) {
  std::vector<syntax::Jump> jumps;
  for (const FlowEvent& event : events)
    if (event.kind == FlowEvent::Kind::Jump) jumps.push_back(event.jump);
  return jumps;
}

/// The numbers that jumps get as the old events become the new ones.
JumpNumbers Analysis::number_jumps(const syntax::ChunkChange& change, const std::vector<FlowEvent>& old_events,
                                   const std::vector<FlowEvent>& new_events) const {
  const std::vector<syntax::Jump> before = jumps_of(old_events);
  const std::vector<syntax::Jump> after = jumps_of(new_events);
  const std::size_t common = std::min(before.size(), after.size());
  std::size_t head = 0;
  while (head < common && jump_alike(before[head], after[head])) ++head;
  std::size_t tail = 0;
  while (tail < common - head && jump_alike(before[before.size() - 1 - tail], after[after.size() - 1 - tail])) ++tail;
  std::size_t above = 0;
  for (std::size_t chunk = 0; chunk < change.first; ++chunk) above += rows_[chunk].jumps.jump_count();
  return {.first = static_cast<std::uint32_t>(above + head),
          .end = static_cast<std::uint32_t>(above + before.size() - tail),
          .shift = static_cast<std::uint32_t>(after.size() - before.size())};
}

/// Marks chunks as stale, except the changed ones, if a jump in them has another effect now, or if an assigned value
/// now falls into another cell of constants.
void Analysis::check_changed_jumps_again(const syntax::ChunkChange& change, const JumpMap& old_jumps,
                                         JumpNumbers numbers) {
  RegisterSet recut = 0;
  for (int reg = 1; reg <= dialect::kRegisterCount; ++reg)
    if (jumps_.constants(reg) != old_jumps.constants(reg)) recut |= register_bit(reg);
  const bool compares_alike = jumps_.compares_registers() == old_jumps.compares_registers();
  const auto is_cut_alike = [&](const FlowEvents::Assignment& assignment) {
    const auto& [value, line, reg] = assignment;
    return (recut & register_bit(reg)) == 0 ||
           ValueSet::of(value, jumps_.constants(reg)) == ValueSet::of(value, old_jumps.constants(reg));
  };
  std::uint32_t jump = 0;
  for (std::size_t chunk = 0; chunk < rows_.size(); ++chunk) {
    Row& row = rows_[chunk];
    if (chunk >= change.first && chunk < change.first + change.inserted) {
      jump += static_cast<std::uint32_t>(row.jumps.jump_count());
      continue;
    }
    const std::uint32_t shift = chunk < change.first ? 0 : numbers.shift;
    row.is_stale |= row.may_assign;
    // Registers whose value an IF below reads now and did not read before the edit, or the reverse.
    const auto differently_read = [&] { return jumps_.read_before(jump) ^ old_jumps.read_before(jump - shift); };
    RegisterSet differing = differently_read();
    row.jumps.each_part(
        [&] {
          row.is_stale |= !jumps_.is_equivalent(jump, old_jumps, jump - shift);
          ++jump;
          differing = differently_read();
        },
        [&](std::size_t first, std::size_t end, RegisterSet assigned) {
          if (first == end) return;
          row.is_stale |= !compares_alike || (differing & assigned) != 0;
          for (; (recut & assigned) != 0 && first < end && !row.is_stale; ++first)
            row.is_stale |= !is_cut_alike(row.jumps.assignment(first));
        });
  }
}

/// Updates the jumps after these events have been replaced.
void Analysis::follow_jumps(const syntax::ChunkChange& change, const std::vector<FlowEvent>& old_events) {
  std::vector<FlowEvent> new_events;
  for (std::size_t i = change.first; i < change.first + change.inserted; ++i)
    rows_[i].jumps.each([&](const FlowEvent& event) { new_events.push_back(event); });
  const bool same = std::equal(old_events.begin(), old_events.end(), new_events.begin(), new_events.end(),
                               [](const FlowEvent& a, const FlowEvent& b) { return a.means_the_same(b); });
  if (same) {
    if (!jumps_.empty()) move_jumps(change);
    return;
  }
  const JumpNumbers numbers = number_jumps(change, old_events, new_events);
  const JumpMap old_jumps = std::exchange(jumps_, find_jumps(old_events, new_events));
  if (numbers.shift != 0) {
    for (std::size_t chunk = change.first + change.inserted; chunk < rows_.size(); ++chunk) {
      numbers.apply(rows_[chunk].checked->before);
      numbers.apply(rows_[chunk].checked->outcome);
    }
    numbers.apply(end_);
  }
  check_changed_jumps_again(change, old_jumps, numbers);
}

// --- Check

bool Analysis::update(const std::function<bool()>& stop) {
  follow_text();
  return check_stale(rows_.size(), stop) && follow_centers(stop);
}

bool Analysis::has_known_findings() const {
  for (std::size_t i = 0; i < rows_.size(); ++i)
    if (rows_[i].is_new) return false;
  return rows_.size() > 0;
}

bool Analysis::update_before(std::size_t line, const std::function<bool()>& stop) {
  follow_text();
  return check_stale(line < document_.line_count() ? document_.chunk_of_line(line) : rows_.size(), stop);
}

/// Whether centers are suspected of counting from the start depends on all arcs of the program. When that changes,
/// chunks with arcs that are legal both ways are checked again.
bool Analysis::follow_centers(const std::function<bool()>& stop) {
  bool suspects = false;
  for (std::size_t i = 0; i < rows_.size(); ++i) suspects |= rows_[i].centers.from_start;
  if (suspects == suspects_centers_) return true;
  suspects_centers_ = suspects;
  for (std::size_t i = 0; i < rows_.size(); ++i) rows_[i].is_stale |= rows_[i].centers.open;
  return check_stale(rows_.size(), stop);
}

/// Checks the stale chunks before `end`.
bool Analysis::check_stale(std::size_t end, const std::function<bool()>& stop) {
  for (std::size_t i = 0; i < end; ++i)
    if (rows_[i].is_stale && !check_from(i, end, stop)) return false;
  return true;
}

/// Marks the chunks that are to be checked after a change of the text.
void Analysis::follow_text() {
  lines_checked_ = 0;
  const bool is_first = rows_.size() == 0;
  const auto change = rows_.change_to(document_);
  Frontier at_change = is_first ? Checker::start(setup_) : before(change.first);
  std::vector<FlowEvent> old_events;
  for (std::size_t i = change.first; i < change.first + change.removed; ++i) {
    rows_[i].jumps.each([&](const FlowEvent& event) { old_events.push_back(event); });
    counts_.remove(rows_[i].checked->outcome);
  }
  rows_.follow(document_, change, [&](std::size_t chunk) {
    Row fresh;
    read_jumps(chunk, fresh);
    return fresh;
  });
  const bool has_changed = change.removed + change.inserted > 0;
  if (has_changed) follow_jumps(change, old_events);
  line_count_ = document_.line_count();
  // A jump above may lead elsewhere now. So what is stale is checked from the top: paths that wait for a label which
  // the edit has removed must not be followed beyond it.
  if (has_changed) start_at(change.first, std::move(at_change));
}

/// Has the lines from a chunk on checked with this frontier before them.
void Analysis::start_at(std::size_t chunk, Frontier frontier) {
  if (chunk == rows_.size()) {
    end_ = std::move(frontier);
    return;
  }
  Row& row = rows_[chunk];
  row.checked->before = std::move(frontier);
  row.shift = {};
  row.is_stale = true;
}

/// Checks from a chunk to before `end`, as long as the frontier differs from the kept one. False if stopped; the rest
/// is then stale.
bool Analysis::check_from(std::size_t chunk, std::size_t end, const std::function<bool()>& stop) {
  Checker checker(setup_, jumps_, suspects_centers_);
  checker.frontier = before(chunk);
  syntax::ChunkTrees trees;
  for (; chunk < end; ++chunk) {
    if (!rows_[chunk].is_stale) {
      if (auto change = change_between(before(chunk), checker.frontier)) {
        chunk = pass_over(chunk, *change);
        if (change->empty()) return true;
        checker.frontier = before(chunk);
        change->apply(checker.frontier);
        if (chunk >= end) break;
      }
    }
    if (stop && lines_checked_ > 0 && stop()) {
      start_at(chunk, std::move(checker.frontier));
      return false;
    }
    trees.read(document_, chunk);
    check_chunk(chunk, trees, checker);
  }
  start_at(chunk, std::move(checker.frontier));
  return true;
}

/// Whether a chunk gives the same findings after this change, and passes it on.
bool Analysis::passes(std::size_t chunk, const FrontierChange& change) const {
  const Row& row = rows_[chunk];
  const auto& [before, outcome] = *row.checked;
  return !row.is_stale && change.passes(row.positions, outcome.only_row, before, setup_.house_rules.get());
}

/// Passes a change over the chunks from this one on, as long as they give the same findings after it. Returns the first
/// chunk that may not; `change` is then that before it.
std::size_t Analysis::pass_over(std::size_t chunk, FrontierChange& change) {
  for (; chunk < rows_.size() && !change.empty(); ++chunk) {
    Row& row = rows_[chunk];
    if (!passes(chunk, change) || !row.shift.add(change.shift)) break;
    auto& [before, outcome] = *row.checked;
    if (change.state) change.state->apply(before.live[0]);
    const Frontier& after = chunk + 1 == rows_.size() ? end_ : rows_[chunk + 1].checked->before;
    change.pass(row.positions, outcome.only_row, after, setup_.house_rules.get());
  }
  return chunk;
}

void Analysis::check_chunk(std::size_t chunk, const syntax::ChunkTrees& trees, Checker& checker) {
  Row& row = rows_[chunk];
  Outcome outcome;
  Frontier before = checker.frontier;
  checker.check_all(trees, outcome);
  lines_checked_ += trees.size();
  row.shift = {};
  row.positions = outcome.positions;
  row.centers = outcome.centers;
  row.may_assign = outcome.may_assign;
  row.is_stale = false;
  row.is_new = false;
  if (row.labels == LabelRange::any()) row.labels = LabelRange::of(trees);
  row.has_text = outcome.has_text;
  row.has_more = !outcome.findings.empty() || !outcome.fold_ends.empty() ||
                 outcome.leads_anywhere_from != Outcome::kNowhere || !outcome.labels.empty() ||
                 !outcome.misspelled_labels.empty() || !outcome.live_jumps.empty() || outcome.assigned != 0;
  outcome.findings.shrink_to_fit();
  outcome.count();
  counts_.remove(row.checked->outcome);
  counts_.add(outcome);
  *row.checked = {std::move(before), std::move(outcome)};
}

FirstFindings Analysis::excerpt(const FirstFindingsOptions& options) const {
  std::size_t last_text = rows_.size();
  while (last_text > 0 && !rows_[last_text - 1].has_text) --last_text;
  std::vector<PlacedOutcome> outcomes;
  for (std::size_t i = 0; i < rows_.size(); ++i)
    if (rows_[i].has_more || i + 1 == last_text)
      outcomes.push_back({&rows_[i].checked->outcome, document_.first_line_of_chunk(i)});
  return conclude(
      outcomes, counts_, end_, jumps_,
      [&](std::size_t line) { return document_.text_of_line(static_cast<std::size_t>(line)); }, options);
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

}  // namespace isocnc::check
