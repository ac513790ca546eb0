#include "interpreter/comparison/comparison.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "interpreter/comparison/alignment.h"
#include "interpreter/comparison/change_list.h"
#include "interpreter/comparison/named_changes.h"
#include "interpreter/comparison/operation_order.h"

namespace isocnc::comparison {

using geometry::Vec3;

namespace {

/// Aligns two runs and names what differs, `a` being the old one.
std::vector<BehaviorChange> changes_between(const RunPair& all, const ComparisonOptions& options) {
  std::optional<OrderedRuns> ordered = in_same_order(all, options);
  const RunPair runs = ordered ? RunPair{ordered->a, ordered->b, all.tolerance, all.budget} : all;
  const std::vector<AlignedPiece> pieces = align(runs);
  ChangeList changes(runs, options);
  if (ordered)
    for (OperationChange& operation : ordered->changes)
      changes.add_operation(std::move(operation.change), {operation.action, operation.action, 0, 0});
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const AlignedPiece& piece = pieces[i];
    if (piece.kind == AlignedPiece::Kind::Same) {
      changes.follow_shift({piece.a_begin, piece.a_end, piece.b_begin, piece.b_end}, piece.shift);
      changes.compare_feeds_along(piece);
      continue;
    }
    name_part(changes, part_at(pieces, i));
  }
  return changes.take();
}

/// A run without the actions that do not count.
RecordedRun without_ignored(RecordedRun run, const ComparisonOptions& options) {
  const auto is_ignored = [&](const MachineAction& action) {
    const bool is_time = action.kind == ActionKind::Dwell || action.kind == ActionKind::ExactStop;
    return (options.ignores_time && is_time) || (options.ignores_speed && action.kind == ActionKind::Spindle);
  };
  std::vector<std::size_t> kept{0};  // How many of the first actions are kept.
  for (const MachineAction& action : run.actions) kept.push_back(kept.back() + (is_ignored(action) ? 0 : 1));
  for (ActionDecision& decision : run.decisions) decision.action = kept[decision.action];
  for (ActionSpindle& spindle : run.spindles)
    if (spindle.cause) spindle.cause = kept[*spindle.cause];
  if (options.ignores_speed) {
    run.spindles.resize(1);
    for (MachineAction& action : run.actions) action.spindle = 0;
  }
  run.actions.erase(std::remove_if(run.actions.begin(), run.actions.end(), is_ignored), run.actions.end());
  return run;
}

/// The change as it is if both programs are swapped.
BehaviorChange mirrored(BehaviorChange change) {
  std::swap(change.old_lines, change.new_lines);
  std::swap(change.old_start, change.new_start);
  std::swap(change.old_value, change.new_value);
  std::swap(change.old_motions, change.new_motions);
  if (change.shift) change.shift = -*change.shift;
  change.later = -change.later;
  std::swap(change.old_tool, change.new_tool);
  std::swap(change.old_cause, change.new_cause);
  change.seconds *= -1;
  if (change.kind == ChangeKind::Added || change.kind == ChangeKind::Removed)
    change.kind = change.kind == ChangeKind::Added ? ChangeKind::Removed : ChangeKind::Added;
  return change;
}

}  // namespace

bool is_before(const RecordedRun& left, const RecordedRun& right) {
  if (left.actions.size() != right.actions.size()) return left.actions.size() < right.actions.size();
  const auto key = [](const RecordedRun& run, const MachineAction& action) {
    const bool is_arc = action.arc != MachineAction::kNone;
    const ActionArc arc = is_arc ? run.arcs[action.arc] : ActionArc{};
    return std::tuple(action.kind, action.is_rapid, action.to.tip.x(), action.to.tip.y(), action.to.tip.z(),
                      action.to.b, action.to.c, action.feed, action.value, action.side, value_of(run, action), is_arc,
                      arc.sweep_deg, arc.center.x(), arc.center.y(), arc.center.z());
  };
  for (std::size_t i = 0; i < left.actions.size(); ++i) {
    const MachineAction& one = left.actions[i];
    const MachineAction& other = right.actions[i];
    if (one.is_line() && other.is_line() && one.to == other.to && one.feed == other.feed && one.value == other.value &&
        one.side == other.side && one.is_rapid == other.is_rapid)
      continue;
    const auto left_key = key(left, one);
    const auto right_key = key(right, other);
    if (left_key != right_key) return left_key < right_key;
  }
  return false;
}

std::vector<BehaviorChange> compare(const RecordedRun& old_run, const RecordedRun& new_run,
                                    const ComparisonOptions& options) {
  if (options.ignores_speed || options.ignores_time) {
    ComparisonOptions rest = options;
    rest.ignores_speed = rest.ignores_time = false;
    return compare(without_ignored(old_run, options), without_ignored(new_run, options), rest);
  }
  const bool is_swapped = is_before(new_run, old_run);
  WorkBudget budget;
  const RunPair runs{is_swapped ? new_run : old_run, is_swapped ? old_run : new_run, options.tolerance, &budget};
  std::vector<BehaviorChange> changes = changes_between(runs, options);
  if (!is_swapped) return changes;
  for (BehaviorChange& change : changes) change = mirrored(std::move(change));
  return changes;
}

std::vector<AlignedStep> aligned_steps(const RecordedRun& old_run, const RecordedRun& new_run, double tolerance) {
  const bool is_swapped = is_before(new_run, old_run);
  const RunPair runs{is_swapped ? new_run : old_run, is_swapped ? old_run : new_run, tolerance};
  std::vector<AlignedStep> steps;
  for (const AlignedPiece& piece : align(runs)) {
    if (piece.kind != AlignedPiece::Kind::Same) {
      steps.push_back({piece.a_begin, piece.a_end, piece.b_begin, piece.b_end, false});
      continue;
    }
    for (PlaceInBoth place{piece.a_begin, piece.b_begin}; place.a < piece.a_end;) {
      const PlaceInBoth next = same_step(runs, place, piece.shift).value_or(PlaceInBoth{place.a + 1, place.b + 1});
      steps.push_back({place.a, next.a, place.b, next.b, true});
      place = next;
    }
  }
  if (!is_swapped) return steps;
  for (AlignedStep& step : steps) {
    std::swap(step.old_begin, step.new_begin);
    std::swap(step.old_end, step.new_end);
  }
  return steps;
}

}  // namespace isocnc::comparison
