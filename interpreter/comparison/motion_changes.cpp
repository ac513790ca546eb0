#include "interpreter/comparison/named_changes.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>
#include <utility>

#include "interpreter/comparison/action_path.h"

namespace isocnc::comparison {

using geometry::Vec3;

namespace {

/// Names the differences between motions.
class MotionNamer {
 public:
  explicit MotionNamer(ChangeList& changes) : changes_(changes), runs_(changes.runs()), options_(changes.options()) {}

  /// Names how one motion goes otherwise than the other one, if it does. Both end in the same place but for a shift.
  /// `around` is the shift of what stands around them.
  void name_way(std::size_t i, std::size_t k, const Vec3& shift, const Vec3& around) {
    if (goes_same_way(runs_, a(i), b(k)) && !starts_elsewhere(i, k, shift)) return;
    const Vec3 at_start = b(k).from.tip - a(i).from.tip;
    const Vec3 at_end = b(k).to.tip - a(i).to.tip;
    const ActionRanges at{i, i + 1, k, k + 1};
    BehaviorChange& change = changes_.add(ChangeKind::Shape, at);
    change.distance = shown_distance(at, (at_end - at_start).norm() <= options_.tolerance ? at_end : around);
    if (!change.distance && is_other_way_around(runs_, a(i), b(k))) change.distance = 0;
  }

  void name_motions(const MotionBlock& block, const DifferentPart& part) {
    const RunPair motions{block.a, block.b, runs_.tolerance};
    const ActionRanges whole = before_end(part.actions);
    StepGroup group{block, whole, {}};
    Vec3 around = part.before;
    for (const MotionStep& step : block.steps) {
      if (!step.is_in_place) {
        group.steps.push_back(step);
        continue;
      }
      const NamedOfClosing closing = name_group(group, &step);
      group.steps.clear();
      const ActionRanges at = actions_of(block, step.motions, whole);
      changes_.follow_shift(at, step.shift);
      if (step.kind == MotionStep::Kind::Pair) {
        if (closing != NamedOfClosing::Way) name_closing(block, step, at, around);
        // Where one of them takes another path, its feed is that of another motion; a rapid there is worth a word.
        const bool is_other_feed =
            closing == NamedOfClosing::Path && !a(at.a_end - 1).is_rapid && !b(at.b_end - 1).is_rapid;
        if (is_other_feed) {
          changes_.compare_sides(at.a_end - 1, at.b_end - 1);
        } else {
          compare_values(block, step.motions.a_begin, step.motions.b_begin);
        }
      } else {
        if (closing != NamedOfClosing::Way) name_way_of_parts(block, step, at);
        same_step(motions, {step.motions.a_begin, step.motions.b_begin}, step.shift,
                  [&](std::size_t i, std::size_t k) { compare_values(block, i, k); });
      }
      around = step.shift;
    }
    name_group(group, nullptr);
  }

 private:
  const MachineAction& a(std::size_t i) const { return runs_.a.actions[i]; }
  const MachineAction& b(std::size_t i) const { return runs_.b.actions[i]; }

  /// Two motions of a block, with all of their parts.
  void compare_feeds(const MotionBlock& block, std::size_t i, std::size_t k) {
    changes_.compare_feeds(block.a_firsts[i], block.b_firsts[k]);
    changes_.compare_feeds(block.a_actions[i], block.b_actions[k]);
  }

  /// The same, and the side of their compensation.
  void compare_values(const MotionBlock& block, std::size_t i, std::size_t k) {
    compare_feeds(block, i, k);
    changes_.compare_sides(block.a_actions[i], block.b_actions[k]);
  }

  /// Names how motions go that end in the same place, if they do so otherwise.
  void name_closing(const MotionBlock& block, const MotionStep& step, const ActionRanges& at, const Vec3& around) {
    const Vec3 at_start = b(at.b_begin).from.tip - a(at.a_begin).from.tip;
    const bool starts_together = (at_start - around).norm() <= options_.tolerance;
    if (starts_together && name_way_of_parts(block, step, at)) return;
    name_way(at.a_begin, at.b_begin, step.shift, around);
  }

  /// Joined lines are the same path; their parts may still be further apart than the tolerance. Says whether there are
  /// such.
  bool name_way_of_parts(const MotionBlock& block, const MotionStep& step, const ActionRanges& at) {
    const auto has_parts = [](const std::vector<std::size_t>& firsts, const std::vector<std::size_t>& actions,
                              std::size_t begin, std::size_t end) {
      return !std::equal(firsts.begin() + static_cast<std::ptrdiff_t>(begin),
                         firsts.begin() + static_cast<std::ptrdiff_t>(end),
                         actions.begin() + static_cast<std::ptrdiff_t>(begin));
    };
    const ActionRanges& motions = step.motions;
    if (!has_parts(block.a_firsts, block.a_actions, motions.a_begin, motions.a_end) &&
        !has_parts(block.b_firsts, block.b_actions, motions.b_begin, motions.b_end))
      return false;
    // Of short motions the wrong ones may have been taken for each other, which is looked into later.
    constexpr std::size_t kFewParts = 4;
    if (std::max(at.a_end - at.a_begin, at.b_end - at.b_begin) > kFewParts) return true;
    constexpr double kWritten = 0.001;  // mm: what the last digit of a coordinate is worth.
    const std::optional<double> mm = shown_distance(at, step.shift);
    if (mm && *mm > options_.tolerance + kWritten) changes_.add(ChangeKind::Shape, at).distance = mm;
    return true;
  }

  /// A part without what ends the runs.
  ActionRanges before_end(ActionRanges at) const {
    const auto leave_out = [](const RecordedRun& run, std::size_t begin, std::size_t& end) {
      if (begin < end && run.actions[end - 1].kind == ActionKind::End) --end;
    };
    leave_out(runs_.a, at.a_begin, at.a_end);
    leave_out(runs_.b, at.b_begin, at.b_end);
    return at;
  }

  /// The actions from the first to the last one of some motions. Motions of one run alone that the other one would have
  /// behind its last motion are at the end of `whole` there.
  static ActionRanges actions_of(const MotionBlock& block, const ActionRanges& motions, const ActionRanges& whole) {
    const auto range = [](const std::vector<std::size_t>& firsts, const std::vector<std::size_t>& actions,
                          std::size_t begin, std::size_t end, std::size_t whole_end) {
      const std::size_t first = begin < actions.size() ? firsts[begin] : whole_end;
      return std::pair(first, begin < end ? actions[end - 1] + 1 : first);
    };
    ActionRanges at;
    std::tie(at.a_begin, at.a_end) =
        range(block.a_firsts, block.a_actions, motions.a_begin, motions.a_end, whole.a_end);
    std::tie(at.b_begin, at.b_end) =
        range(block.b_firsts, block.b_actions, motions.b_begin, motions.b_end, whole.b_end);
    return at;
  }

  /// Steps in a row that are not in place.
  struct StepGroup {
    const MotionBlock& block;
    const ActionRanges& whole;
    std::vector<MotionStep> steps;

    ActionRanges actions(std::size_t first, std::size_t last) const {
      const ActionRanges& begin = steps[first].motions;
      const ActionRanges& end = steps[last].motions;
      return actions_of(block, {begin.a_begin, end.a_end, begin.b_begin, end.b_end}, whole);
    }
    ActionRanges all() const { return actions(0, steps.size() - 1); }
    /// Together with the motions that follow it in place.
    ActionRanges closed(const MotionStep* closing) const {
      ActionRanges at = all();
      if (closing == nullptr || closing->kind != MotionStep::Kind::Pair) return at;
      at.a_end = block.a_actions[closing->motions.a_begin] + 1;
      at.b_end = block.b_actions[closing->motions.b_begin] + 1;
      return at;
    }
    std::size_t count(MotionStep::Kind kind) const {
      return static_cast<std::size_t>(
          std::count_if(steps.begin(), steps.end(), [&](const MotionStep& step) { return step.kind == kind; }));
    }
    std::pair<std::size_t, std::size_t> pair(const MotionStep& step) const {
      return {block.a_actions[step.motions.a_begin], block.b_actions[step.motions.b_begin]};
    }
  };

  /// What is named of the motions that close a group: how they go, or that one of them takes another path.
  enum class NamedOfClosing : std::uint8_t { None, Way, Path };

  /// Names steps that are not in place.
  NamedOfClosing name_group(StepGroup& group, const MotionStep* closing) {
    if (group.steps.empty()) return NamedOfClosing::None;
    pair_all(group);
    const std::size_t pairs = group.count(MotionStep::Kind::Pair);
    const std::size_t only_a = group.count(MotionStep::Kind::OnlyInA);
    const std::size_t only_b = group.count(MotionStep::Kind::OnlyInB);
    const Vec3& shift = group.steps.front().shift;
    for (const MotionStep& step : group.steps) {
      if (step.kind != MotionStep::Kind::Pair || has_its_rapid_elsewhere(group, step)) continue;
      const auto [i, k] = group.pair(step);
      if (!a(i).is_inverse_time) compare_feeds(group.block, step.motions.a_begin, step.motions.b_begin);
      changes_.compare_sides(i, k);
    }
    if (pairs == 0 && (only_a == 0 || only_b == 0)) {
      if (closing != nullptr && closing->kind == MotionStep::Kind::Pair) {
        const auto [i, k] = group.pair(*closing);
        if (!goes_same_way(runs_, a(i), b(k))) {
          name_shape(group.closed(closing), group.closed(closing), shift);
          return NamedOfClosing::Way;
        }
      }
      return name_count(group, closing, only_b > 0) ? NamedOfClosing::Path : NamedOfClosing::None;
    }
    const std::optional<Vec3> common = common_shift(group);
    const bool has_same_ways = std::all_of(group.steps.begin(), group.steps.end(), [&](const MotionStep& step) {
      if (step.kind != MotionStep::Kind::Pair) return true;
      const auto [i, k] = group.pair(step);
      return goes_same_way(runs_, a(i), b(k));
    });
    if (only_a == 0 && only_b == 0 && (common || has_same_ways)) {
      name_moved_by_frames(group, closing);
    } else if (!name_shortened(group, common)) {
      name_shape(group.all(), group.closed(closing), shift);
    }
    return NamedOfClosing::None;
  }

  /// Motions that only one run has. The one that follows them may go where the other run never goes: a retract is lost,
  /// and the rapid above the part becomes a cut through it. Says whether it does.
  bool name_count(const StepGroup& group, const MotionStep* closing, bool is_added) {
    BehaviorChange& change = changes_.add(is_added ? ChangeKind::Added : ChangeKind::Removed, group.all());
    if (closing == nullptr || closing->kind != MotionStep::Kind::Pair) return false;
    const Vec3& shift = group.steps.front().shift;
    const ActionRanges at = group.closed(closing);
    const ActionRanges next{at.a_end - 1, at.a_end, at.b_end - 1, at.b_end};
    // What is added within a motion leaves a part of it to the next one.
    const bool has_same_feed =
        a(next.a_begin).is_rapid == b(next.b_begin).is_rapid && a(next.a_begin).feed == b(next.b_begin).feed;
    if (has_same_feed)
      change.seconds = seconds_of(runs_.b, at.b_begin, at.b_end) - seconds_of(runs_.a, at.a_begin, at.a_end);
    const double deviation = options_.tolerance / 8;
    std::vector<Vec3> a_chain = chain(runs_.a, is_added ? next.a_begin : at.a_begin, at.a_end, deviation);
    const std::vector<Vec3> b_chain = chain(runs_.b, is_added ? at.b_begin : next.b_begin, at.b_end, deviation);
    for (Vec3& point : a_chain) point += shift;
    const std::optional<double> off = is_added ? distance_from(a_chain, b_chain, deviation, distances_left())
                                               : distance_from(b_chain, a_chain, deviation, distances_left());
    if (!off || *off <= options_.tolerance) return false;
    // How far the motion itself goes away; where what is added goes, its own numbers say.
    std::vector<Vec3> next_chain = is_added ? chain(runs_.b, next.b_begin, next.b_end, deviation)
                                            : chain(runs_.a, next.a_begin, next.a_end, deviation);
    if (!is_added)
      for (Vec3& point : next_chain) point += shift;
    const std::optional<double> next_off =
        distance_from(next_chain, is_added ? a_chain : b_chain, deviation, distances_left());
    if (!next_off) return false;
    change.distance = std::max(*off, *next_off);
    change.end_distance = shown_distance(at, shift).value_or(0);
    if (is_added) {
      change.old_lines = lines_of(runs_.a, next.a_begin, next.a_end);
      change.old_tool = tool_of(runs_.a, a(next.a_begin));
    } else {
      change.new_lines = lines_of(runs_.b, next.b_begin, next.b_end);
      change.new_tool = tool_of(runs_.b, b(next.b_begin));
    }
    return true;
  }

  /// Whether one run has a rapid where the other one has a feed move, which has the same rapid, as a way, beside it: it
  /// has a motion more or less.
  bool has_its_rapid_elsewhere(const StepGroup& group, const MotionStep& step) const {
    const auto [i, k] = group.pair(step);
    if (a(i).is_rapid == b(k).is_rapid || group.count(MotionStep::Kind::Pair) == group.steps.size()) return false;
    const ActionRanges all = group.all();
    const Vec3 way = a(i).is_rapid ? a(i).to.tip - a(i).from.tip : b(k).to.tip - b(k).from.tip;
    const auto has_rapid = [&](const RecordedRun& run, std::size_t begin, std::size_t end) {
      const std::span actions = std::span(run.actions).subspan(begin, end - begin);
      return std::any_of(actions.begin(), actions.end(), [&](const MachineAction& each) {
        return each.is_motion() && each.is_rapid && (each.to.tip - each.from.tip - way).norm() <= options_.tolerance;
      });
    };
    return a(i).is_rapid ? has_rapid(runs_.b, all.b_begin, all.b_end) : has_rapid(runs_.a, all.a_begin, all.a_end);
  }

  /// Takes as many lines of both as pairs in their order.
  void pair_all(StepGroup& group) const {
    const std::size_t only_a = group.count(MotionStep::Kind::OnlyInA);
    if (only_a == 0 || only_a != group.count(MotionStep::Kind::OnlyInB)) return;
    const ActionRanges& first = group.steps.front().motions;
    const ActionRanges& last = group.steps.back().motions;
    const auto is_line = [](const MachineAction& motion) { return motion.is_line(); };
    const std::span of_a = std::span(group.block.a.actions).subspan(first.a_begin, last.a_end - first.a_begin);
    const std::span of_b = std::span(group.block.b.actions).subspan(first.b_begin, last.b_end - first.b_begin);
    if (!std::all_of(of_a.begin(), of_a.end(), is_line) || !std::all_of(of_b.begin(), of_b.end(), is_line)) return;
    std::vector<MotionStep> pairs;
    for (std::size_t i = first.a_begin, k = first.b_begin; i < last.a_end; ++i, ++k)
      pairs.push_back({MotionStep::Kind::Pair, {i, i + 1, k, k + 1}, false, group.steps.front().shift});
    group.steps = std::move(pairs);
  }

  void name_shape(const ActionRanges& at, const ActionRanges& path, const Vec3& shift) {
    BehaviorChange& change = changes_.add(ChangeKind::Shape, at);
    change.distance = shown_distance(path, shift);
    change.turned = turn(path, shift);
  }

  /// By how much B or C differ along two paths, degrees; 0 within the tolerance.
  double turn(const ActionRanges& at, const Vec3& shift) const {
    const std::span of_a = std::span(runs_.a.actions).subspan(at.a_begin, at.a_end - at.a_begin);
    const std::span of_b = std::span(runs_.b.actions).subspan(at.b_begin, at.b_end - at.b_begin);
    const double degrees = turn_between(of_a, of_b, shift, distances_left()).value_or(0);
    return degrees > options_.tolerance ? degrees : 0;
  }

  /// What a frame moves is apart from what is moved in it.
  void name_moved_by_frames(const StepGroup& group, const MotionStep* closing) {
    const auto is_by_frame = [&](const MotionStep& step) {
      const auto [i, k] = group.pair(step);
      return changes_.is_moved_by_frame(i, k);
    };
    const bool are_one = common_shift(group).has_value();
    for (std::size_t first = 0, last = 0; first < group.steps.size(); first = last) {
      const bool is_by = is_by_frame(group.steps[first]);
      while (last < group.steps.size() && (are_one || is_by_frame(group.steps[last]) == is_by)) ++last;
      StepGroup part{group.block, group.whole, {}};
      for (std::size_t i = first; i < last; ++i) part.steps.push_back(group.steps[i]);
      name_moved(part, last == group.steps.size() ? closing : nullptr, common_shift(part));
    }
  }

  void name_moved(const StepGroup& group, const MotionStep* closing, const std::optional<Vec3>& common) {
    BehaviorChange& change = changes_.add(ChangeKind::Moved, group.all());
    for (const MotionStep& step : group.steps) {
      const auto [i, k] = group.pair(step);
      change.end_distance = std::max(change.end_distance, (b(k).to.tip - a(i).to.tip).norm());
      change.turned = std::max({change.turned, std::abs(a(i).to.b - b(k).to.b), std::abs(a(i).to.c - b(k).to.c)});
    }
    if (change.turned <= options_.tolerance) change.turned = 0;
    if (common && common->norm() > options_.tolerance) change.shift = common;
    change.distance = change.shift ? common->norm() : shown_distance(group.closed(closing), group.steps.front().shift);
    if (!common) return;
    for (const MotionStep& step : group.steps) {
      const auto [i, k] = group.pair(step);
      name_way(i, k, *common, group.steps.front().shift);
    }
  }

  /// Motions that one run does not have, beside others that are moved as a whole: the retraction after the last hole.
  bool name_shortened(const StepGroup& group, const std::optional<Vec3>& common) {
    if (!common || common->norm() <= options_.tolerance) return false;
    std::size_t first_pair = 0;
    while (first_pair < group.steps.size() && group.steps[first_pair].kind != MotionStep::Kind::Pair) ++first_pair;
    if (first_pair == 0) return false;
    const MotionStep::Kind only = group.steps.front().kind;
    for (std::size_t i = 0; i < group.steps.size(); ++i) {
      if (group.steps[i].kind != (i < first_pair ? only : MotionStep::Kind::Pair)) return false;
      if (i < first_pair) continue;
      const auto [left, right] = group.pair(group.steps[i]);
      const ActionRanges& motions = group.steps[i].motions;
      const Vec3 from =
          group.block.b.actions[motions.b_begin].from.tip - group.block.a.actions[motions.a_begin].from.tip;
      if ((from - *common).norm() > options_.tolerance || !goes_same_way(runs_, a(left), b(right))) return false;
    }
    changes_.add(only == MotionStep::Kind::OnlyInB ? ChangeKind::Added : ChangeKind::Removed,
                 group.actions(0, first_pair - 1));
    BehaviorChange& moved = changes_.add(ChangeKind::Moved, group.actions(first_pair, group.steps.size() - 1));
    moved.shift = common;
    moved.distance = common->norm();
    return true;
  }

  /// By how much all motions of both are moved, if it is the same.
  std::optional<Vec3> common_shift(const StepGroup& group) const {
    std::optional<Vec3> common;
    for (const MotionStep& step : group.steps) {
      if (step.kind != MotionStep::Kind::Pair) continue;
      const auto [i, k] = group.pair(step);
      const Vec3 shift = b(k).to.tip - a(i).to.tip;
      if (!common) common = shift;
      if ((shift - *common).norm() > options_.tolerance) return std::nullopt;
      if (std::max(std::abs(a(i).to.b - b(k).to.b), std::abs(a(i).to.c - b(k).to.c)) > options_.tolerance)
        return std::nullopt;
    }
    return common;
  }

  static std::vector<Vec3> chain(const RecordedRun& run, std::size_t begin, std::size_t end, double deviation) {
    return chain_of(run, std::span(run.actions).subspan(begin, end - begin), deviation);
  }
  std::size_t* distances_left() const { return runs_.budget == nullptr ? nullptr : &runs_.budget->distances; }

  /// `fineness` divides how far the result may be off.
  std::optional<double> distance(const ActionRanges& at, const Vec3& shift, double fineness) const {
    const double deviation = options_.tolerance / 8 / fineness;
    std::vector<Vec3> old_chain = chain(runs_.a, at.a_begin, at.a_end, deviation);
    for (Vec3& point : old_chain) point += shift;
    return distance_of(old_chain, chain(runs_.b, at.b_begin, at.b_end, deviation), options_.tolerance / 4 / fineness,
                       distances_left());
  }

  /// The distance where only B and C differ is none.
  std::optional<double> shown_distance(const ActionRanges& at, const Vec3& shift) const {
    std::optional<double> mm = distance(at, shift, 1);
    // What differs by little more than the tolerance must not be shown as less.
    constexpr double kFine = 32;
    if (mm && *mm > options_.tolerance / 2 && *mm < options_.tolerance * 2) mm = distance(at, shift, kFine);
    return mm && *mm <= options_.tolerance / 2 ? std::nullopt : mm;
  }

  static const MachineAction* motion_before(const RecordedRun& run, std::size_t action) {
    while (action > 0)
      if (run.actions[--action].is_motion()) return &run.actions[action];
    return nullptr;
  }

  /// Whether two motions start in different places though what comes before them ends in the same one: the machines
  /// have other homes, or tools of other lengths.
  bool starts_elsewhere(std::size_t i, std::size_t k, const Vec3& shift) const {
    const Vec3 at_start = b(k).from.tip - a(i).from.tip;
    if (std::min(at_start.norm(), (at_start - shift).norm()) <= options_.tolerance) return false;
    if (tool_of(runs_.a, a(i)) != tool_of(runs_.b, b(k))) return false;
    const MachineAction* const a_before = motion_before(runs_.a, i);
    const MachineAction* const b_before = motion_before(runs_.b, k);
    if (a_before == nullptr || b_before == nullptr) return a_before == b_before;
    return ends_together(runs_, *a_before, *b_before, shift) ||
           ends_together(runs_, *a_before, *b_before, Vec3::Zero());
  }

  ChangeList& changes_;
  const RunPair& runs_;
  const ComparisonOptions& options_;
};

}  // namespace

void name_closing_way(ChangeList& changes, const DifferentPart& part) {
  MotionNamer(changes).name_way(part.actions.a_end - 1, part.actions.b_end - 1, part.after, part.before);
}

void name_motions(ChangeList& changes, const MotionBlock& block, const DifferentPart& part) {
  MotionNamer(changes).name_motions(block, part);
}

}  // namespace isocnc::comparison
