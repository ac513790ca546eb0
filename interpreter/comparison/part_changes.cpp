#include "interpreter/comparison/named_changes.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "interpreter/comparison/action_path.h"
#include "interpreter/comparison/effect_steps.h"
#include "interpreter/comparison/gap_steps.h"

namespace isocnc::comparison {

using geometry::Vec3;

namespace {

/// Names what differs in a part.
class PartNamer {
 public:
  explicit PartNamer(ChangeList& changes) : changes_(changes), runs_(changes.runs()), options_(changes.options()) {}

  void name_part(const DifferentPart& part) {
    if (name_end(part) || name_path(part)) return;
    name_inside(part);
  }

 private:
  const MachineAction& a(std::size_t i) const { return runs_.a.actions[i]; }
  const MachineAction& b(std::size_t i) const { return runs_.b.actions[i]; }

  void name_inside(const DifferentPart& part) {
    const std::optional<MotionBlock> motions = motion_block(runs_, part);
    if (!motions) {
      name_whole(without_closing(part));
      return name_closing(part);
    }
    const bool is_same_path = motions->is_same_path() && motions->steps.size() > (part.is_closed ? 1U : 0U);
    if (!is_same_path && (name_way_back(part) || name_order(part))) return;
    comparison::name_motions(changes_, *motions, part);
    PlaceInBoth next{part.actions.a_begin, part.actions.b_begin};
    for (const EffectStep& step : effect_steps(runs_, part.actions, *motions)) {
      const std::size_t i =
          step.a ? *step.a : std::max(next.a, next_action(*motions, part.actions, kOfA, kOfB, *step.b));
      const std::size_t k =
          step.b ? *step.b : std::max(next.b, next_action(*motions, part.actions, kOfB, kOfA, *step.a));
      const ActionRanges at{i, i + (step.a ? step.a_count : 0), k, k + (step.b ? step.b_count : 0)};
      name_effect(step, at);
      next = {at.a_end, at.b_end};
    }
  }

  /// The motions that close a part of which the rest has a name.
  void name_closing(const DifferentPart& part) {
    if (!part.is_closed) return;
    const ActionRanges& at = part.actions;
    changes_.follow_shift({at.a_end - 1, at.a_end, at.b_end - 1, at.b_end}, part.after);
    name_closing_way(changes_, part);
    changes_.compare_feeds(at.a_end - 1, at.b_end - 1);
    changes_.compare_sides(at.a_end - 1, at.b_end - 1);
  }

  /// Too large to look into.
  void name_whole(const ActionRanges& at) {
    BehaviorChange& change = changes_.add(ChangeKind::Shape, at);
    if (change.old_motions + change.new_motions == 0) change.kind = ChangeKind::Function;
  }

  /// The range without the motions that close a part.
  static ActionRanges without_closing(const DifferentPart& part) {
    const std::size_t closing = part.is_closed ? 1 : 0;
    const ActionRanges& at = part.actions;
    return {at.a_begin, at.a_end - closing, at.b_begin, at.b_end - closing};
  }

  /// A range without what both do at its ends besides motions.
  ActionRanges trimmed(ActionRanges at) const {
    const auto are_same = [&](std::size_t i, std::size_t k) {
      return !a(i).is_motion() && is_same_effect(runs_, a(i), b(k));
    };
    for (; at.a_begin < at.a_end && at.b_begin < at.b_end && are_same(at.a_begin, at.b_begin); ++at.b_begin)
      ++at.a_begin;
    for (; at.a_begin < at.a_end && at.b_begin < at.b_end && are_same(at.a_end - 1, at.b_end - 1); --at.b_end)
      --at.a_end;
    return at;
  }

  static std::span<const ActionDecision> decisions(const RecordedRun& run, std::size_t begin, std::size_t end) {
    const auto first = std::partition_point(run.decisions.begin(), run.decisions.end(),
                                            [&](const ActionDecision& each) { return each.action < begin; });
    const auto last = std::partition_point(first, run.decisions.end(),
                                           [&](const ActionDecision& each) { return each.action <= end; });
    return std::span(run.decisions)
        .subspan(static_cast<std::size_t>(first - run.decisions.begin()), static_cast<std::size_t>(last - first));
  }

  /// An IF that one run takes and the other one does not.
  struct PathFork {
    const ActionDecision* taken = nullptr;
    const ActionDecision* not_taken = nullptr;  ///< None where the other run has no such IF.
    bool is_in_a = false;
  };

  /// The IFs at which the runs part, in their order. IFs of both runs belong together where they follow the same
  /// number of others and as many stand in a row, without an action between them.
  static std::vector<PathFork> jumps_between(std::span<const ActionDecision> of_a,
                                             std::span<const ActionDecision> of_b) {
    const auto row_of = [](std::span<const ActionDecision> decisions) {
      std::size_t count = 0;
      while (count < decisions.size() && decisions[count].action == decisions[0].action) ++count;
      return decisions.first(count);
    };
    std::vector<PathFork> jumps;
    while (!of_a.empty() || !of_b.empty()) {
      const std::span a_row = row_of(of_a);
      const std::span b_row = row_of(of_b);
      const bool are_pairs = a_row.size() == b_row.size();
      const bool is_in_a = a_row.size() > b_row.size();
      const std::span longer = is_in_a ? a_row : b_row;
      const std::span shorter = is_in_a ? b_row : a_row;
      std::size_t first = 0;
      while (first < shorter.size() && longer[first].is_taken == shorter[first].is_taken) ++first;
      if (are_pairs && first < longer.size()) {
        const bool is_taken_in_a = a_row[first].is_taken;
        jumps.push_back({is_taken_in_a ? &a_row[first] : &b_row[first], is_taken_in_a ? &b_row[first] : &a_row[first],
                         is_taken_in_a});
      } else if (!are_pairs && longer[first].is_taken) {
        jumps.push_back({&longer[first], nullptr, is_in_a});
      }
      of_a = of_a.subspan(a_row.size());
      of_b = of_b.subspan(b_row.size());
    }
    return jumps;
  }

  /// What the run that does not jump does where the other one jumps, and what that one does instead. None if that is
  /// nothing.
  std::optional<ActionRanges> skipped(const PathFork& jump, const DifferentPart& part) const {
    const ActionRanges at = without_closing(part);
    if (jump.not_taken != nullptr) {
      const std::size_t from_a = (jump.is_in_a ? jump.taken : jump.not_taken)->action;
      const std::size_t from_b = (jump.is_in_a ? jump.not_taken : jump.taken)->action;
      if (jump.is_in_a ? from_b >= at.b_end : from_a >= at.a_end) return std::nullopt;
      return ActionRanges{std::min(from_a, at.a_end), at.a_end, std::min(from_b, at.b_end), at.b_end};
    }
    AlignedPiece gap{AlignedPiece::Kind::Gap, at.a_begin, at.a_end, at.b_begin, at.b_end, part.after};
    const auto steps = gap_steps(runs_, gap, part.before);
    if (!steps) return std::nullopt;
    const GapStep only_other = jump.is_in_a ? GapStep::OnlyInB : GapStep::OnlyInA;
    ActionRanges found{at.a_begin, at.a_begin, at.b_begin, at.b_begin};
    for (const GapStep step : *steps) {
      const bool is_there = (jump.is_in_a ? found.a_end : found.b_end) == jump.taken->action;
      if ((jump.is_in_a ? found.a_end : found.b_end) > jump.taken->action) break;
      if (step != GapStep::OnlyInB) ++found.a_end;
      if (step != GapStep::OnlyInA) ++found.b_end;
      if (is_there && step == only_other) continue;
      if (is_there && (jump.is_in_a ? found.b_begin + 1 < found.b_end : found.a_begin + 1 < found.a_end)) {
        if (step != GapStep::OnlyInB) --found.a_end;
        if (step != GapStep::OnlyInA) --found.b_end;
        break;
      }
      found = {found.a_end, found.a_end, found.b_end, found.b_end};
    }
    const bool is_nothing = jump.is_in_a ? found.b_begin == found.b_end : found.a_begin == found.a_end;
    return is_nothing ? std::nullopt : std::optional(found);
  }

  /// Names what an IF skips, and what stands before and after that.
  bool name_path(const DifferentPart& part) {
    const ActionRanges inner = without_closing(part);
    const std::vector<PathFork> jumps =
        jumps_between(decisions(runs_.a, inner.a_begin, inner.a_end), decisions(runs_.b, inner.b_begin, inner.b_end));
    return std::any_of(jumps.begin(), jumps.end(), [&](const PathFork& jump) {
      const std::optional<ActionRanges> at = skipped(jump, part);
      // Of what is no motion, its own words say more.
      const bool has_motion =
          at && motion_count(runs_.a, at->a_begin, at->a_end) + motion_count(runs_.b, at->b_begin, at->b_end) > 0;
      if (has_motion) name_path(part, jump, *at);
      return has_motion;
    });
  }

  void name_path(const DifferentPart& part, const PathFork& jump, const ActionRanges& at) {
    const ActionRanges& whole = part.actions;
    const DifferentPart first{{whole.a_begin, at.a_begin, whole.b_begin, at.b_begin}, part.before, part.before};
    if (!is_empty(first.actions)) name_inside(first);
    BehaviorChange& change = changes_.add(ChangeKind::Path, at);
    const std::size_t cause = jump.taken->line;
    (jump.is_in_a ? change.old_cause : change.new_cause) = cause;
    // The program that jumps has at least its IF.
    std::optional<ChangedLines>& jumping = jump.is_in_a ? change.old_lines : change.new_lines;
    if (!jumping) jumping = ChangedLines{cause, cause};
    jumping->first = std::min(jumping->first, cause);
    const auto start_at = [](std::size_t& start, std::size_t line) { start = std::min(start, line); };
    start_at(jump.is_in_a ? change.old_start : change.new_start, cause);
    if (jump.not_taken != nullptr) start_at(jump.is_in_a ? change.new_start : change.old_start, jump.not_taken->line);
    const DifferentPart last{{at.a_end, whole.a_end, at.b_end, whole.b_end}, part.before, part.after, part.is_closed};
    if (!is_empty(without_closing(last))) {
      name_inside(last);
    } else {
      name_closing(part);
    }
  }

  static bool is_empty(const ActionRanges& at) { return at.a_begin == at.a_end && at.b_begin == at.b_end; }

  /// The last actions of a part in which one run does nothing but end.
  ActionRanges not_run(const DifferentPart& part) const {
    const ActionRanges& at = part.actions;
    ActionRanges rest{at.a_end - 1, at.a_end, at.b_end - 1, at.b_end};
    const AlignedPiece gap{AlignedPiece::Kind::Gap, at.a_begin, rest.a_begin, at.b_begin, rest.b_begin, part.before};
    const auto steps = gap_steps(runs_, gap, part.before);
    if (!steps) return at;
    for (auto step = steps->rbegin(); step != steps->rend() && *step == steps->back(); ++step) {
      if (*step == GapStep::OnlyInA) --rest.a_begin;
      if (*step == GapStep::OnlyInB) --rest.b_begin;
    }
    return rest;
  }

  /// Where an error ends one run, what the other one does after it is no change of its own.
  bool name_end(const DifferentPart& part) {
    const ActionRanges& at = part.actions;
    const std::size_t old_count = motion_count(runs_.a, at.a_begin, at.a_end);
    const std::size_t new_count = motion_count(runs_.b, at.b_begin, at.b_end);
    if (at.a_end != runs_.a.actions.size() || at.b_end != runs_.b.actions.size() || old_count == new_count)
      return false;
    const MachineAction& left = a(at.a_end - 1);
    const MachineAction& right = b(at.b_end - 1);
    if (left.number == right.number) return false;
    const ActionRanges rest = not_run(part);
    const DifferentPart first{{at.a_begin, rest.a_begin, at.b_begin, rest.b_begin}, part.before, part.before};
    if (!is_empty(first.actions)) name_inside(first);
    BehaviorChange& change = changes_.add(ChangeKind::End, rest);
    change.old_value = value_of(runs_.a, left);
    change.new_value = value_of(runs_.b, right);
    return true;
  }

  /// The actions of a range in b that are those of a in another order, by what `is_same` says; none if they are not.
  /// One that is the same in its own place stays there.
  template <class IsSame>
  std::vector<std::size_t> permuted(const ActionRanges& at, const IsSame& is_same) const {
    constexpr std::size_t kMaxPermuted = 64;
    const std::size_t count = at.a_end - at.a_begin;
    if (count < 2 || count > kMaxPermuted || at.b_end - at.b_begin != count) return {};
    std::vector<bool> is_used(count);
    std::vector<std::size_t> order(count);
    for (std::size_t i = 0; i < count; ++i) {
      is_used[i] = is_same(a(at.a_begin + i), b(at.b_begin + i));
      order[i] = at.b_begin + i;
    }
    const std::vector<bool> stays = is_used;
    for (std::size_t i = 0; i < count; ++i) {
      if (stays[i]) continue;
      std::size_t k = 0;
      while (k < count && (is_used[k] || !is_same(a(at.a_begin + i), b(at.b_begin + k)))) ++k;
      if (k == count) return {};
      is_used[k] = true;
      order[i] = at.b_begin + k;
    }
    return order;
  }

  /// Whether all motions of a part that end elsewhere do so by one vector along one axis of the frame in force: a
  /// coordinate has changed.
  bool is_one_coordinate(const ActionRanges& at) const {
    std::optional<Vec3> common;
    for (std::size_t i = at.a_begin, k = at.b_begin; i < at.a_end; ++i, ++k) {
      const Vec3 moved = b(k).to.tip - a(i).to.tip;
      if (moved.norm() <= options_.tolerance) continue;
      if (!common) common = moved;
      if ((moved - *common).norm() > options_.tolerance) return false;
    }
    if (!common) return false;
    const Vec3 inside = runs_.a.frames[a(at.a_begin).frame].frame.axes.transpose() * *common;
    return (inside.array().abs() > options_.tolerance).count() == 1;
  }

  /// Whether the tolerance cannot have taken the way of one motion for that of another one.
  bool is_clear_order(const ActionRanges& at, const std::vector<std::size_t>& order) const {
    constexpr double kFarApart = 4;
    bool is_other_order = false;
    for (std::size_t i = 0; i < order.size(); ++i) {
      const std::size_t own = at.b_begin + i;
      if (order[i] == own) continue;
      is_other_order = true;
      const MachineAction& left = a(at.a_begin + i);
      const Vec3 apart = (b(own).to.tip - b(own).from.tip) - (left.to.tip - left.from.tip);
      if (apart.norm() <= kFarApart * options_.tolerance && goes_same_way(runs_, left, b(own))) return false;
    }
    return is_other_order;
  }

  bool name_permuted(const ActionRanges& at, const std::vector<std::size_t>& order) {
    if (order.empty()) return false;
    changes_.add(ChangeKind::Reordered, at);
    for (std::size_t i = 0; i < order.size(); ++i) changes_.compare_feeds_alone(at.a_begin + i, order[i]);
    return true;
  }

  /// The same places in another order; or the same ways, together with the motion that closes the part.
  bool name_order(const DifferentPart& part) {
    const auto is_same = [&](const MachineAction& left, const MachineAction& right) {
      return is_same_action(runs_, left, right, part.before);
    };
    const auto is_same_way = [&](const MachineAction& left, const MachineAction& right) {
      if (!left.is_motion() || !right.is_motion()) return false;
      const Vec3 old_way = left.to.tip - left.from.tip;
      const Vec3 new_way = right.to.tip - right.from.tip;
      return (old_way - new_way).norm() <= options_.tolerance && left.from.b == left.to.b && left.from.c == left.to.c &&
             right.from.b == right.to.b && right.from.c == right.to.c && goes_same_way(runs_, left, right);
    };
    const ActionRanges inner = trimmed(without_closing(part));
    if (name_permuted(inner, permuted(inner, is_same))) {
      name_closing(part);
      return true;
    }
    if (!part.is_closed || part.after != part.before) return false;
    const std::vector<std::size_t> order = permuted(part.actions, is_same_way);
    if (!is_clear_order(part.actions, order) || is_one_coordinate(part.actions)) return false;
    return name_permuted(part.actions, order);
  }

  /// A closed contour the other way around.
  bool name_way_back(const DifferentPart& part) {
    const ActionRanges& at = part.actions;
    const std::size_t count = at.a_end - at.a_begin;
    if (!part.is_closed || count < 2 || at.b_end - at.b_begin != count || part.before != part.after) return false;
    for (std::size_t i = 0; i < count; ++i) {
      const MachineAction& left = a(at.a_begin + i);
      const MachineAction& right = b(at.b_end - 1 - i);
      if (!left.is_motion() || !right.is_motion() || left.is_rapid || right.is_rapid) return false;
      if (!turns_back(left, right, part.before)) return false;
    }
    changes_.add(ChangeKind::Shape, at).distance = 0;
    for (std::size_t i = 0; i < count; ++i) changes_.compare_feeds_alone(at.a_begin + i, at.b_end - 1 - i);
    return true;
  }

  /// Whether a motion goes from the end of another one to its start on its way.
  bool turns_back(const MachineAction& left, const MachineAction& right, const Vec3& shift) const {
    MachineAction back = right;
    std::swap(back.from, back.to);
    if (!ends_together(runs_, left, back, shift)) return false;
    const ActionPath left_path(runs_.a, left);
    const ActionPath right_path(runs_.b, right);
    constexpr int kPoints = 16;
    for (int i = 0; i < kPoints; ++i) {
      const double part = static_cast<double>(i) / kPoints;
      const geometry::Pose there = left_path.at(part);
      const geometry::Pose back_there = right_path.at(1 - part);
      if ((back_there.tip - there.tip - shift).norm() > options_.tolerance) return false;
      if (std::max(std::abs(there.b - back_there.b), std::abs(there.c - back_there.c)) > options_.tolerance)
        return false;
    }
    return true;
  }

  /// What belongs to one of the two runs.
  struct RunSide {
    std::vector<std::size_t> MotionBlock::*actions;
    std::size_t ActionRanges::*begin;
    std::size_t ActionRanges::*end;
  };
  static constexpr RunSide kOfA{&MotionBlock::a_actions, &ActionRanges::a_begin, &ActionRanges::a_end};
  static constexpr RunSide kOfB{&MotionBlock::b_actions, &ActionRanges::b_begin, &ActionRanges::b_end};

  /// The action that one run does next where the other has an action between motions.
  static std::size_t next_action(const MotionBlock& block, const ActionRanges& part, const RunSide& one,
                                 const RunSide& other, std::size_t action) {
    const std::vector<std::size_t>& others = block.*other.actions;
    const auto motion = std::lower_bound(others.begin(), others.end(), action);
    const auto before = static_cast<std::size_t>(motion - others.begin());
    const auto next = std::partition_point(block.steps.begin(), block.steps.end(),
                                           [&](const MotionStep& step) { return step.motions.*other.begin < before; });
    const std::size_t motions = next == block.steps.begin() ? 0 : (next - 1)->motions.*one.end;
    return motions == 0 ? part.*one.begin : (block.*one.actions)[motions - 1] + 1;
  }

  static std::string value_together(const RecordedRun& run, std::size_t begin, std::size_t count) {
    MachineAction action = run.actions[begin];
    for (std::size_t i = 1; i < count; ++i) action.value += run.actions[begin + i].value;
    return value_of(run, action);
  }

  void name_effect(const EffectStep& step, const ActionRanges& at) {
    if (step.is_same && step.later == 0) return;
    BehaviorChange& change = changes_.add(kind_of((step.a ? a(at.a_begin) : b(at.b_begin)).kind), at);
    if (step.a) change.old_value = value_together(runs_.a, at.a_begin, step.a_count);
    if (step.b) change.new_value = value_together(runs_.b, at.b_begin, step.b_count);
    if (!step.is_same) return;
    change.later = step.later;
    change.distance = std::abs(step.later);
  }
  ChangeList& changes_;
  const RunPair& runs_;
  const ComparisonOptions& options_;
};

}  // namespace

void name_part(ChangeList& changes, const DifferentPart& part) { PartNamer(changes).name_part(part); }

}  // namespace isocnc::comparison
