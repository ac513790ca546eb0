#include "interpreter/comparison/comparison.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "interpreter/comparison/action_path.h"
#include "interpreter/comparison/alignment.h"
#include "interpreter/comparison/effect_steps.h"
#include "interpreter/comparison/gap_steps.h"
#include "interpreter/comparison/motion_steps.h"

namespace isocnc::comparison {

using geometry::Vec3;

namespace {

constexpr double kSameFeed = 1e-4;  ///< Relative: what F loses where it is written in inches or under G93.

/// A number without zeros at its end.
std::string shown(double number) {
  std::string text = fmt::format("{:.4f}", number);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string value_of(const RecordedRun& run, const MachineAction& action) {
  switch (action.kind) {
    case ActionKind::Motion:
      return action.is_rapid ? "G00" : "F" + shown(action.feed);
    case ActionKind::ExactStop:
      return "G09";
    case ActionKind::Dwell:
      return shown(action.value) + " s";
    case ActionKind::Spindle:
      if (action.number == 5) return "M05";
      return fmt::format("S{} M{:02}", shown(action.value), action.number);
    case ActionKind::Function: {
      const running::FunctionEvent& function = run.functions[action.number];
      std::string text = fmt::format("M{:02}", function.number);
      for (const execution::FunctionParameter& parameter : function.parameters)
        text += fmt::format(" P{}={}", parameter.number, shown(parameter.value));
      return text;
    }
    case ActionKind::Signal:
      return fmt::format("G{}", action.number);
    case ActionKind::Tool:
      return running::tool_name(run.tools[action.tool].code);
    case ActionKind::End:
      if (action.number == 0) return "M02";
      return std::string(dialect::definition(static_cast<dialect::DiagnosticId>(action.number - 1)).code);
  }
  return "";
}

ChangeKind kind_of(ActionKind kind) {
  switch (kind) {
    case ActionKind::Motion:
      return ChangeKind::Moved;
    case ActionKind::Dwell:
      return ChangeKind::Dwell;
    case ActionKind::Spindle:
      return ChangeKind::Speed;
    case ActionKind::Tool:
      return ChangeKind::Tool;
    case ActionKind::End:
      return ChangeKind::End;
    case ActionKind::ExactStop:
    case ActionKind::Function:
    case ActionKind::Signal:
      return ChangeKind::Function;
  }
  return ChangeKind::Function;
}

/// Names the differences between two aligned runs, `a` being the old one.
class ChangeNamer {
 public:
  ChangeNamer(const RunPair& runs, const ComparisonOptions& options) : runs_(runs), options_(options) {}

  std::vector<BehaviorChange> changes(const std::vector<AlignedPiece>& pieces) {
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const AlignedPiece& piece = pieces[i];
      if (piece.kind == AlignedPiece::Kind::Same) {
        follow_shift({piece.a_begin, piece.a_end, piece.b_begin, piece.b_end}, piece.shift);
        compare_feeds_along(piece);
        continue;
      }
      DifferentPart part{.actions = {piece.a_begin, piece.a_end, piece.b_begin, piece.b_end},
                         .before = i == 0 ? Vec3(Vec3::Zero()) : pieces[i - 1].shift,
                         .after = piece.shift,
                         .is_closed = piece.kind == AlignedPiece::Kind::Closing};
      if (!part.is_closed && i + 1 < pieces.size()) {
        const AlignedPiece& next = pieces[i + 1];
        part.after = next.shift;
        part.is_closed = next.kind == AlignedPiece::Kind::Closing;
        if (part.is_closed) {
          part.actions.a_end = next.a_end;
          part.actions.b_end = next.b_end;
          ++i;
        }
      }
      name_part(part);
    }
    close_shift();
    close_feed();
    join_moved_blocks();
    sort();
    return std::move(changes_);
  }

 private:
  struct OpenShift {
    ActionRanges actions;
    Vec3 shift = Vec3::Zero();
  };
  struct OpenFeed {
    ActionRanges actions;
    std::string old_value;
    std::string new_value;
  };

  const MachineAction& a(std::size_t i) const { return runs_.a.actions[i]; }
  const MachineAction& b(std::size_t i) const { return runs_.b.actions[i]; }

  static std::optional<ChangedLines> lines(const RecordedRun& run, std::size_t begin, std::size_t end) {
    if (begin == end) return std::nullopt;
    ChangedLines lines{run.actions[begin].line, run.actions[begin].line};
    for (std::size_t i = begin; i < end; ++i) {
      lines.first = std::min<std::size_t>(lines.first, run.actions[i].line);
      lines.last = std::max<std::size_t>(lines.last, run.actions[i].line);
    }
    return lines;
  }
  static std::size_t motions(const RecordedRun& run, std::size_t begin, std::size_t end) {
    const std::span actions = std::span(run.actions).subspan(begin, end - begin);
    return static_cast<std::size_t>(
        std::count_if(actions.begin(), actions.end(), [](const MachineAction& each) { return each.is_motion(); }));
  }

  static std::optional<execution::ToolCode> tool_of(const RecordedRun& run, const MachineAction& action) {
    return action.tool == MachineAction::kNone ? std::nullopt : std::optional(run.tools[action.tool].code);
  }

  BehaviorChange& add(ChangeKind kind, const ActionRanges& at) {
    BehaviorChange change{.kind = kind,
                          .old_lines = lines(runs_.a, at.a_begin, at.a_end),
                          .new_lines = lines(runs_.b, at.b_begin, at.b_end),
                          .old_motions = motions(runs_.a, at.a_begin, at.a_end),
                          .new_motions = motions(runs_.b, at.b_begin, at.b_end)};
    if (at.a_begin < at.a_end) change.old_tool = tool_of(runs_.a, a(at.a_begin));
    if (at.b_begin < at.b_end) change.new_tool = tool_of(runs_.b, b(at.b_begin));
    places_.push_back(at);
    return changes_.emplace_back(std::move(change));
  }

  // Shifts.

  void follow_shift(const ActionRanges& at, const Vec3& shift) {
    if (shift_ && shift_->shift != shift) close_shift();
    if (shift.isZero(0)) return;
    if (!shift_) shift_ = OpenShift{at, shift};
    // The row ends with a motion: what follows it is nowhere else.
    std::size_t a_end = at.a_end;
    std::size_t b_end = at.b_end;
    while (a_end > at.a_begin && !a(a_end - 1).is_motion()) --a_end;
    while (b_end > at.b_begin && !b(b_end - 1).is_motion()) --b_end;
    if (a_end > at.a_begin) shift_->actions.a_end = a_end;
    if (b_end > at.b_begin) shift_->actions.b_end = b_end;
  }

  void close_shift() {
    if (!shift_) return;
    const OpenShift open = *std::exchange(shift_, std::nullopt);
    const ActionFrame& old_frame = runs_.a.frames[a(open.actions.a_begin).frame];
    const ActionFrame& new_frame = runs_.b.frames[b(open.actions.b_begin).frame];
    const Vec3 moved = new_frame.frame.origin - old_frame.frame.origin - open.shift;
    const bool is_frame = moved.norm() <= options_.tolerance && old_frame.frame.axes.isApprox(new_frame.frame.axes);
    BehaviorChange& change = add(is_frame ? ChangeKind::Frame : ChangeKind::Moved, open.actions);
    change.distance = open.shift.norm();
    change.shift = open.shift;
    if (!is_frame) return;
    change.old_cause = old_frame.line;
    change.new_cause = new_frame.line;
  }

  // Feeds.

  static bool is_same_feed(const MachineAction& a, const MachineAction& b) {
    if (a.is_rapid != b.is_rapid) return false;
    const auto near = [](double one, double other) {
      return std::abs(one - other) <= kSameFeed * std::max(std::abs(one), std::abs(other));
    };
    return near(a.feed, b.feed) || (a.is_inverse_time && b.is_inverse_time && near(a.value, b.value));
  }

  void compare_feeds(std::size_t i, std::size_t k) {
    const MachineAction& left = a(i);
    const MachineAction& right = b(k);
    if (!left.is_motion() || !right.is_motion()) return;
    if (options_.ignores_feed && left.is_rapid == right.is_rapid) return;
    if (is_same_feed(left, right)) {
      if (!left.is_rapid) close_feed();
      return;
    }
    std::string old_value = value_of(runs_.a, left);
    std::string new_value = value_of(runs_.b, right);
    if (!feed_ || feed_->old_value != old_value || feed_->new_value != new_value) {
      close_feed();
      feed_ = OpenFeed{{i, i + 1, k, k + 1}, std::move(old_value), std::move(new_value)};
    }
    feed_->actions.a_end = i + 1;
    feed_->actions.b_end = k + 1;
  }

  void compare_feeds_along(const AlignedPiece& piece) {
    for (PlaceInBoth place{piece.a_begin, piece.b_begin}; place.a < piece.a_end;) {
      overlaps_.clear();
      const auto next =
          same_step(runs_, place, piece.shift, [&](std::size_t i, std::size_t k) { overlaps_.emplace_back(i, k); });
      for (const auto& [i, k] : overlaps_) compare_feeds(i, k);
      place = next.value_or(PlaceInBoth{place.a + 1, place.b + 1});
    }
  }

  void close_feed() {
    if (!feed_) return;
    OpenFeed open = std::move(*std::exchange(feed_, std::nullopt));
    BehaviorChange& change = add(ChangeKind::Feed, open.actions);
    change.old_value = std::move(open.old_value);
    change.new_value = std::move(open.new_value);
  }

  /// Feeds of motions that do not follow each other in both runs.
  void compare_feeds_alone(std::size_t i, std::size_t k) {
    close_feed();
    compare_feeds(i, k);
    close_feed();
  }

  // Distances.

  std::optional<double> distance(const ActionRanges& at, const Vec3& shift) const {
    const double deviation = options_.tolerance / 8;
    std::vector<Vec3> old_chain =
        chain_of(runs_.a, std::span(runs_.a.actions).subspan(at.a_begin, at.a_end - at.a_begin), deviation);
    for (Vec3& point : old_chain) point += shift;
    return distance_of(
        old_chain, chain_of(runs_.b, std::span(runs_.b.actions).subspan(at.b_begin, at.b_end - at.b_begin), deviation),
        options_.tolerance / 4);
  }

  /// The distance where only B and C differ is none.
  std::optional<double> shown_distance(const ActionRanges& at, const Vec3& shift) const {
    const std::optional<double> mm = distance(at, shift);
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

  /// Names how one motion goes otherwise than the other one, if it does. Both end in the same place but for a shift.
  void name_way(std::size_t i, std::size_t k, const Vec3& shift) {
    if (goes_same_way(runs_, a(i), b(k)) && !starts_elsewhere(i, k, shift)) return;
    const Vec3 at_start = b(k).from.tip - a(i).from.tip;
    const Vec3 at_end = b(k).to.tip - a(i).to.tip;
    const ActionRanges at{i, i + 1, k, k + 1};
    BehaviorChange& change = add(ChangeKind::Shape, at);
    change.distance = shown_distance(at, (at_end - at_start).norm() <= options_.tolerance ? at_end : shift);
    if (!change.distance && is_other_way_around(runs_, a(i), b(k))) change.distance = 0;
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

  /// The range without the motions that close a part.
  static ActionRanges without_closing(const DifferentPart& part) {
    const std::size_t closing = part.is_closed ? 1 : 0;
    const ActionRanges& at = part.actions;
    return {at.a_begin, at.a_end - closing, at.b_begin, at.b_end - closing};
  }

  void name_part(const DifferentPart& part) {
    if (name_end(part) || name_path(part)) return;
    name_inside(part);
  }

  void name_inside(const DifferentPart& part) {
    const std::optional<MotionBlock> motions = motion_block(runs_, part);
    if (!motions) {
      name_whole(without_closing(part));
      return name_closing(part);
    }
    const bool is_same_path = motions->is_same_path() && motions->steps.size() > (part.is_closed ? 1U : 0U);
    if (!is_same_path && (name_way_back(part) || name_order(part))) return;
    name_motions(*motions, part);
    std::size_t place = part.actions.a_begin;
    for (const EffectStep& step : effect_steps(runs_, part.actions, *motions)) {
      place = step.a ? *step.a : std::max(place, place_in_a(*motions, part.actions, *step.b));
      name_effect(step, place);
    }
  }

  /// The motions that close a part of which the rest has a name.
  void name_closing(const DifferentPart& part) {
    if (!part.is_closed) return;
    const ActionRanges& at = part.actions;
    follow_shift({at.a_end - 1, at.a_end, at.b_end - 1, at.b_end}, part.after);
    name_way(at.a_end - 1, at.b_end - 1, part.after);
    compare_feeds(at.a_end - 1, at.b_end - 1);
  }

  /// Too large to look into.
  void name_whole(const ActionRanges& at) {
    BehaviorChange& change = add(ChangeKind::Shape, at);
    if (change.old_motions + change.new_motions == 0) change.kind = ChangeKind::Function;
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
      if (!is_there && (jump.is_in_a ? found.a_end : found.b_end) > jump.taken->action) break;
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
      if (at) name_path(part, jump, *at);
      return at.has_value();
    });
  }

  void name_path(const DifferentPart& part, const PathFork& jump, const ActionRanges& at) {
    const ActionRanges& whole = part.actions;
    const DifferentPart first{{whole.a_begin, at.a_begin, whole.b_begin, at.b_begin}, part.before, part.before};
    if (!is_empty(first.actions)) name_inside(first);
    BehaviorChange& change = add(ChangeKind::Path, at);
    const std::size_t cause = jump.taken->line;
    (jump.is_in_a ? change.old_cause : change.new_cause) = cause;
    // The program that jumps has at least its IF.
    std::optional<ChangedLines>& jumping = jump.is_in_a ? change.old_lines : change.new_lines;
    if (!jumping) jumping = ChangedLines{cause, cause};
    jumping->first = std::min(jumping->first, cause);
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
    const std::size_t old_count = motions(runs_.a, at.a_begin, at.a_end);
    const std::size_t new_count = motions(runs_.b, at.b_begin, at.b_end);
    if (at.a_end != runs_.a.actions.size() || at.b_end != runs_.b.actions.size() || old_count == new_count)
      return false;
    const MachineAction& left = a(at.a_end - 1);
    const MachineAction& right = b(at.b_end - 1);
    if (left.number == right.number) return false;
    const ActionRanges rest = not_run(part);
    const DifferentPart first{{at.a_begin, rest.a_begin, at.b_begin, rest.b_begin}, part.before, part.before};
    if (!is_empty(first.actions)) name_inside(first);
    BehaviorChange& change = add(ChangeKind::End, rest);
    change.old_value = value_of(runs_.a, left);
    change.new_value = value_of(runs_.b, right);
    return true;
  }

  /// The actions of a range in b that are those of a in another order, by what `is_same` says; none if they are not.
  template <class IsSame>
  std::vector<std::size_t> permuted(const ActionRanges& at, const IsSame& is_same) const {
    constexpr std::size_t kMaxPermuted = 64;
    const std::size_t count = at.a_end - at.a_begin;
    if (count < 2 || count > kMaxPermuted || at.b_end - at.b_begin != count) return {};
    std::vector<bool> is_used(count);
    std::vector<std::size_t> order;
    for (std::size_t i = at.a_begin; i < at.a_end; ++i) {
      std::size_t k = 0;
      while (k < count && (is_used[k] || !is_same(a(i), b(at.b_begin + k)))) ++k;
      if (k == count) return {};
      is_used[k] = true;
      order.push_back(at.b_begin + k);
    }
    return order;
  }

  bool name_permuted(const ActionRanges& at, const std::vector<std::size_t>& order) {
    if (order.empty()) return false;
    add(ChangeKind::Reordered, at);
    for (std::size_t i = 0; i < order.size(); ++i) compare_feeds_alone(at.a_begin + i, order[i]);
    return true;
  }

  /// Whether two actions are the same but for what comes before them: a motion from elsewhere straight to the same
  /// place is, an arc has to be the whole path.
  bool is_same_action(const MachineAction& left, const MachineAction& right, const Vec3& shift) const {
    if (left.kind != right.kind) return false;
    if (!left.is_motion()) return is_same_effect(runs_, left, right);
    if (!ends_together(runs_, left, right, shift)) return false;
    if ((left.is_line() && right.is_line()) || (left.is_by_joints && right.is_by_joints)) return true;
    return (right.from.tip - left.from.tip - shift).norm() <= options_.tolerance && goes_same_way(runs_, left, right);
  }

  /// The same places in another order; or the same ways, together with the motion that closes the part.
  bool name_order(const DifferentPart& part) {
    const auto is_same = [&](const MachineAction& left, const MachineAction& right) {
      return is_same_action(left, right, part.before);
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
    return name_permuted(part.actions, permuted(part.actions, is_same_way));
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
    add(ChangeKind::Shape, at).distance = 0;
    for (std::size_t i = 0; i < count; ++i) compare_feeds_alone(at.a_begin + i, at.b_end - 1 - i);
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

  // Motions of a part.

  /// The actions from the first to the last one of some motions.
  static ActionRanges actions_of(const MotionBlock& block, const ActionRanges& motions, const ActionRanges& whole) {
    const auto range = [](const std::vector<std::size_t>& actions, std::size_t begin, std::size_t end,
                          std::size_t whole_end) {
      const std::size_t first = begin < actions.size() ? actions[begin] : whole_end;
      return std::pair(first, begin < end ? actions[end - 1] + 1 : first);
    };
    ActionRanges at;
    std::tie(at.a_begin, at.a_end) = range(block.a_actions, motions.a_begin, motions.a_end, whole.a_end);
    std::tie(at.b_begin, at.b_end) = range(block.b_actions, motions.b_begin, motions.b_end, whole.b_end);
    return at;
  }

  void name_motions(const MotionBlock& block, const DifferentPart& part) {
    const RunPair motions{block.a, block.b, runs_.tolerance};
    StepGroup group{block, part.actions, {}};
    for (const MotionStep& step : block.steps) {
      if (!step.is_in_place) {
        group.steps.push_back(step);
        continue;
      }
      const bool has_way = name_group(group, &step);
      group.steps.clear();
      const ActionRanges at = actions_of(block, step.motions, part.actions);
      follow_shift(at, step.shift);
      if (step.kind == MotionStep::Kind::Pair) {
        if (!has_way) name_way(at.a_begin, at.b_begin, step.shift);
        compare_feeds(at.a_begin, at.b_begin);
      } else {
        same_step(motions, {step.motions.a_begin, step.motions.b_begin}, step.shift,
                  [&](std::size_t i, std::size_t k) { compare_feeds(block.a_actions[i], block.b_actions[k]); });
      }
    }
    name_group(group, nullptr);
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

  /// Names steps that are not in place, and says whether that includes the way of the motions that close them.
  bool name_group(StepGroup& group, const MotionStep* closing) {
    if (group.steps.empty()) return false;
    pair_all(group);
    const std::size_t pairs = group.count(MotionStep::Kind::Pair);
    const std::size_t only_a = group.count(MotionStep::Kind::OnlyInA);
    const std::size_t only_b = group.count(MotionStep::Kind::OnlyInB);
    const Vec3& shift = group.steps.front().shift;
    for (const MotionStep& step : group.steps) {
      if (step.kind != MotionStep::Kind::Pair) continue;
      const auto [i, k] = group.pair(step);
      if (!a(i).is_inverse_time) compare_feeds(i, k);
    }
    if (pairs == 0 && (only_a == 0 || only_b == 0)) {
      if (closing != nullptr && closing->kind == MotionStep::Kind::Pair) {
        const auto [i, k] = group.pair(*closing);
        if (!goes_same_way(runs_, a(i), b(k))) {
          name_shape(group.closed(closing), group.closed(closing), shift);
          return true;
        }
      }
      add(only_b > 0 ? ChangeKind::Added : ChangeKind::Removed, group.all());
      return false;
    }
    const std::optional<Vec3> common = common_shift(group);
    const bool has_same_ways = std::all_of(group.steps.begin(), group.steps.end(), [&](const MotionStep& step) {
      if (step.kind != MotionStep::Kind::Pair) return true;
      const auto [i, k] = group.pair(step);
      return goes_same_way(runs_, a(i), b(k));
    });
    if (only_a == 0 && only_b == 0 && (common || has_same_ways)) {
      name_moved(group, closing, common);
    } else if (!name_shortened(group, common)) {
      name_shape(group.all(), group.closed(closing), shift);
    }
    return false;
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
    add(ChangeKind::Shape, at).distance = shown_distance(path, shift);
  }

  void name_moved(const StepGroup& group, const MotionStep* closing, const std::optional<Vec3>& common) {
    BehaviorChange& change = add(ChangeKind::Moved, group.all());
    for (const MotionStep& step : group.steps) {
      const auto [i, k] = group.pair(step);
      change.turned = std::max({change.turned, std::abs(a(i).to.b - b(k).to.b), std::abs(a(i).to.c - b(k).to.c)});
    }
    if (change.turned <= options_.tolerance) change.turned = 0;
    if (common && common->norm() > options_.tolerance) change.shift = common;
    change.distance = change.shift ? common->norm() : shown_distance(group.closed(closing), group.steps.front().shift);
    if (!common) return;
    for (const MotionStep& step : group.steps) {
      const auto [i, k] = group.pair(step);
      name_way(i, k, *common);
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
      if ((b(right).from.tip - a(left).from.tip - *common).norm() > options_.tolerance ||
          !goes_same_way(runs_, a(left), b(right)))
        return false;
    }
    add(only == MotionStep::Kind::OnlyInB ? ChangeKind::Added : ChangeKind::Removed, group.actions(0, first_pair - 1));
    BehaviorChange& moved = add(ChangeKind::Moved, group.actions(first_pair, group.steps.size() - 1));
    moved.shift = common;
    moved.distance = common->norm();
    return true;
  }

  // What stands between motions.

  /// The action of a beside an action of b between motions.
  static std::size_t place_in_a(const MotionBlock& block, const ActionRanges& part, std::size_t action) {
    const auto motion = std::lower_bound(block.b_actions.begin(), block.b_actions.end(), action);
    const auto before = static_cast<std::size_t>(motion - block.b_actions.begin());
    const auto next = std::partition_point(block.steps.begin(), block.steps.end(),
                                           [&](const MotionStep& step) { return step.motions.b_begin < before; });
    const std::size_t a_motions = next == block.steps.begin() ? 0 : (next - 1)->motions.a_end;
    return a_motions == 0 ? part.a_begin : block.a_actions[a_motions - 1] + 1;
  }

  /// `place` is that in a.
  void name_effect(const EffectStep& step, std::size_t place) {
    if (step.is_same && step.later == 0) return;
    const std::size_t i = place;
    const std::size_t k = step.b.value_or(0);
    BehaviorChange& change =
        add(kind_of((step.a ? a(i) : b(k)).kind), {i, i + (step.a ? 1 : 0), k, k + (step.b ? 1 : 0)});
    if (step.a) change.old_value = value_of(runs_.a, a(i));
    if (step.b) change.new_value = value_of(runs_.b, b(k));
    if (!step.is_same) return;
    change.later = step.later;
    change.distance = std::abs(step.later);
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

  // The whole.

  /// Motions that are removed in one place and added in another one have another order.
  void join_moved_blocks() {
    constexpr std::size_t kMaxChanges = 2000;
    if (changes_.size() > kMaxChanges) return;
    std::vector<bool> is_joined(changes_.size());
    for (std::size_t i = 0; i < changes_.size(); ++i) {
      if (changes_[i].kind != ChangeKind::Removed) continue;
      for (std::size_t k = 0; k < changes_.size(); ++k) {
        if (changes_[k].kind != ChangeKind::Added || is_joined[k] || !is_same_block(places_[i], places_[k])) continue;
        BehaviorChange& change = changes_[i];
        change.kind = ChangeKind::Reordered;
        change.new_lines = changes_[k].new_lines;
        change.new_motions = changes_[k].new_motions;
        change.new_tool = changes_[k].new_tool;
        is_joined[k] = true;
        break;
      }
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < changes_.size(); ++i) {
      if (is_joined[i]) continue;
      if (kept != i) changes_[kept] = std::move(changes_[i]);
      places_[kept++] = places_[i];
    }
    changes_.resize(kept);
    places_.resize(kept);
  }

  bool is_same_block(const ActionRanges& removed, const ActionRanges& added) const {
    const std::size_t count = removed.a_end - removed.a_begin;
    if (added.b_end - added.b_begin != count) return false;
    for (std::size_t i = 0; i < count; ++i) {
      const MachineAction& left = a(removed.a_begin + i);
      const MachineAction& right = b(added.b_begin + i);
      if (!is_same_action(left, right, Vec3::Zero())) return false;
      if (left.is_motion() && !options_.ignores_feed && !is_same_feed(left, right)) return false;
    }
    return true;
  }

  void sort() {
    std::vector<std::size_t> order(changes_.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t left, std::size_t right) {
      const auto key = [&](std::size_t i) { return std::pair(places_[i].a_begin, places_[i].b_begin); };
      return key(left) < key(right);
    });
    std::vector<BehaviorChange> sorted;
    for (const std::size_t i : order) sorted.push_back(std::move(changes_[i]));
    changes_ = std::move(sorted);
  }

  const RunPair& runs_;
  const ComparisonOptions& options_;
  std::vector<BehaviorChange> changes_;
  std::vector<ActionRanges> places_;  ///< Of each change.
  std::optional<OpenShift> shift_;
  std::optional<OpenFeed> feed_;
  std::vector<std::pair<std::size_t, std::size_t>> overlaps_;
};

/// A run without the actions that do not count.
RecordedRun without_ignored(RecordedRun run, const ComparisonOptions& options) {
  const auto is_ignored = [&](const MachineAction& action) {
    const bool is_time = action.kind == ActionKind::Dwell || action.kind == ActionKind::ExactStop;
    return (options.ignores_time && is_time) || (options.ignores_speed && action.kind == ActionKind::Spindle);
  };
  std::vector<std::size_t> kept{0};  // How many of the first actions are kept.
  for (const MachineAction& action : run.actions) kept.push_back(kept.back() + (is_ignored(action) ? 0 : 1));
  for (ActionDecision& decision : run.decisions) decision.action = kept[decision.action];
  run.actions.erase(std::remove_if(run.actions.begin(), run.actions.end(), is_ignored), run.actions.end());
  return run;
}

/// The change as it is if both programs are swapped.
BehaviorChange mirrored(BehaviorChange change) {
  std::swap(change.old_lines, change.new_lines);
  std::swap(change.old_value, change.new_value);
  std::swap(change.old_motions, change.new_motions);
  if (change.shift) change.shift = -*change.shift;
  change.later = -change.later;
  std::swap(change.old_tool, change.new_tool);
  std::swap(change.old_cause, change.new_cause);
  if (change.kind == ChangeKind::Added || change.kind == ChangeKind::Removed)
    change.kind = change.kind == ChangeKind::Added ? ChangeKind::Removed : ChangeKind::Added;
  return change;
}

/// An order of runs that makes the result independent of which one is the old one.
bool is_before(const RecordedRun& left, const RecordedRun& right) {
  if (left.actions.size() != right.actions.size()) return left.actions.size() < right.actions.size();
  const auto key = [](const RecordedRun& run, const MachineAction& action) {
    const bool is_arc = action.arc != MachineAction::kNone;
    const ActionArc arc = is_arc ? run.arcs[action.arc] : ActionArc{};
    return std::tuple(action.kind, action.is_rapid, action.to.tip.x(), action.to.tip.y(), action.to.tip.z(),
                      action.to.b, action.to.c, action.feed, action.value, value_of(run, action), is_arc, arc.sweep_deg,
                      arc.center.x(), arc.center.y(), arc.center.z());
  };
  for (std::size_t i = 0; i < left.actions.size(); ++i) {
    const MachineAction& one = left.actions[i];
    const MachineAction& other = right.actions[i];
    if (one.is_line() && other.is_line() && one.to == other.to && one.feed == other.feed && one.value == other.value &&
        one.is_rapid == other.is_rapid)
      continue;
    const auto left_key = key(left, one);
    const auto right_key = key(right, other);
    if (left_key != right_key) return left_key < right_key;
  }
  return false;
}

}  // namespace

std::vector<BehaviorChange> compare(const RecordedRun& old_run, const RecordedRun& new_run,
                                    const ComparisonOptions& options) {
  if (options.ignores_speed || options.ignores_time) {
    ComparisonOptions rest = options;
    rest.ignores_speed = rest.ignores_time = false;
    return compare(without_ignored(old_run, options), without_ignored(new_run, options), rest);
  }
  const bool is_swapped = is_before(new_run, old_run);
  const RunPair runs{is_swapped ? new_run : old_run, is_swapped ? old_run : new_run, options.tolerance};
  std::vector<BehaviorChange> changes = ChangeNamer(runs, options).changes(align(runs));
  if (!is_swapped) return changes;
  for (BehaviorChange& change : changes) change = mirrored(std::move(change));
  return changes;
}

}  // namespace isocnc::comparison
