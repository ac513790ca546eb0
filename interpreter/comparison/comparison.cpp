#include "interpreter/comparison/comparison.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "interpreter/comparison/action_path.h"
#include "interpreter/comparison/alignment.h"
#include "interpreter/comparison/gap_steps.h"

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

/// Ranges of actions of both runs; the ends are exclusive.
struct ActionRanges {
  std::size_t a_begin = 0;
  std::size_t a_end = 0;
  std::size_t b_begin = 0;
  std::size_t b_end = 0;
};

/// Names the differences between two aligned runs, `a` being the old one.
class ChangeNamer {
 public:
  ChangeNamer(const RunPair& runs, const ComparisonOptions& options) : runs_(runs), options_(options) {}

  std::vector<BehaviorChange> changes(const std::vector<AlignedPiece>& pieces) {
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const AlignedPiece& piece = pieces[i];
      const Vec3 before = i == 0 ? Vec3(Vec3::Zero()) : pieces[i - 1].shift;
      if (piece.kind == AlignedPiece::Kind::Gap) {
        AlignedPiece gap = piece;
        const bool has_next = i + 1 < pieces.size();
        if (has_next) gap.shift = pieces[i + 1].shift;
        name_gap(gap, before, has_next && pieces[i + 1].kind == AlignedPiece::Kind::Closing);
        continue;
      }
      const bool is_after_gap = i > 0 && pieces[i - 1].kind == AlignedPiece::Kind::Gap;
      follow_shift(piece);
      if (piece.kind == AlignedPiece::Kind::Closing) {
        if (!is_after_gap && piece.shift == before) name_shape(piece, before);
        compare_feeds(piece.a_begin, piece.b_begin);
      } else {
        compare_feeds_along(piece);
      }
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
    std::size_t motions = 0;
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

  void follow_shift(const AlignedPiece& piece) {
    if (shift_ && shift_->shift != piece.shift) close_shift();
    if (piece.shift.isZero(0)) return;
    if (!shift_) shift_ = OpenShift{{piece.a_begin, piece.a_end, piece.b_begin, piece.b_end}, piece.shift};
    shift_->motions += motions(runs_.a, piece.a_begin, piece.a_end);
    // The row ends with a motion: what follows it is nowhere else.
    std::size_t a_end = piece.a_end;
    std::size_t b_end = piece.b_end;
    while (a_end > piece.a_begin && !a(a_end - 1).is_motion()) --a_end;
    while (b_end > piece.b_begin && !b(b_end - 1).is_motion()) --b_end;
    if (a_end > piece.a_begin) shift_->actions.a_end = a_end;
    if (b_end > piece.b_begin) shift_->actions.b_end = b_end;
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

  // Gaps.

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

  void name_shape(const AlignedPiece& piece, const Vec3& shift) {
    const ActionRanges at{piece.a_begin, piece.a_end, piece.b_begin, piece.b_end};
    add(ChangeKind::Shape, at).distance = shown_distance(at, shift);
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

  void name_gap(const AlignedPiece& gap, const Vec3& shift, bool is_closed) {
    const ActionRanges at{gap.a_begin, gap.a_end, gap.b_begin, gap.b_end};
    if (name_end(at) || name_path(at) || name_order(at, gap, shift, is_closed)) return;
    const auto steps = gap_steps(runs_, gap, shift);
    if (!steps) return name_whole(at);
    ActionRanges part{gap.a_begin, gap.a_begin, gap.b_begin, gap.b_begin};
    std::vector<GapStep> of_part;
    for (const GapStep step : *steps) {
      if (step == GapStep::Same && a(part.a_end).is_motion()) {
        name_part(part, of_part, shift, a(part.a_end).is_motion());
        compare_feeds(part.a_end, part.b_end);
        part = {part.a_end + 1, part.a_end + 1, part.b_end + 1, part.b_end + 1};
        of_part.clear();
        continue;
      }
      of_part.push_back(step);
      if (step != GapStep::OnlyInB) ++part.a_end;
      if (step != GapStep::OnlyInA) ++part.b_end;
    }
    name_part(part, of_part, shift, is_closed && gap.shift == shift);
  }

  /// Too large to look into.
  void name_whole(const ActionRanges& at) { add(ChangeKind::Shape, at); }

  static std::vector<const ActionDecision*> decisions(const RecordedRun& run, std::size_t begin, std::size_t end) {
    std::vector<const ActionDecision*> decisions;
    const auto first = std::partition_point(run.decisions.begin(), run.decisions.end(),
                                            [&](const ActionDecision& each) { return each.action < begin; });
    for (auto each = first; each != run.decisions.end() && each->action <= end; ++each)
      if (each->is_taken) decisions.push_back(&*each);
    return decisions;
  }

  bool name_path(const ActionRanges& at) {
    const auto old_taken = decisions(runs_.a, at.a_begin, at.a_end);
    const auto new_taken = decisions(runs_.b, at.b_begin, at.b_end);
    if (old_taken.size() == new_taken.size()) return false;
    const bool is_taken_in_new = new_taken.size() > old_taken.size();
    BehaviorChange& change = add(ChangeKind::Path, at);
    const std::size_t cause = (is_taken_in_new ? new_taken : old_taken).front()->line;
    (is_taken_in_new ? change.new_cause : change.old_cause) = cause;
    // The program that jumps has at least its IF.
    std::optional<ChangedLines>& jumping = is_taken_in_new ? change.new_lines : change.old_lines;
    if (!jumping) jumping = ChangedLines{cause, cause};
    jumping->first = std::min(jumping->first, cause);
    return true;
  }

  /// Where an error ends one run, what the other one does after it is no change of its own.
  bool name_end(const ActionRanges& at) {
    const std::size_t old_count = motions(runs_.a, at.a_begin, at.a_end);
    const std::size_t new_count = motions(runs_.b, at.b_begin, at.b_end);
    if (at.a_end != runs_.a.actions.size() || at.b_end != runs_.b.actions.size() || old_count == new_count)
      return false;
    const MachineAction& left = a(at.a_end - 1);
    const MachineAction& right = b(at.b_end - 1);
    if (left.number == right.number) return false;
    BehaviorChange& change = add(ChangeKind::End, at);
    change.old_value = value_of(runs_.a, left);
    change.new_value = value_of(runs_.b, right);
    return true;
  }

  /// Whether one range has the actions of the other in another order, by what `is_same` says.
  template <class IsSame>
  bool is_permutation(const ActionRanges& at, const IsSame& is_same) const {
    constexpr std::size_t kMaxPermuted = 64;
    const std::size_t count = at.a_end - at.a_begin;
    if (count < 2 || count > kMaxPermuted || at.b_end - at.b_begin != count) return false;
    std::vector<bool> is_used(count);
    for (std::size_t i = at.a_begin; i < at.a_end; ++i) {
      std::size_t k = 0;
      while (k < count && (is_used[k] || !is_same(a(i), b(at.b_begin + k)))) ++k;
      if (k == count) return false;
      is_used[k] = true;
    }
    return true;
  }

  /// The same places in another order; or the same ways, together with the motion that closes the gap.
  bool name_order(const ActionRanges& at, const AlignedPiece& gap, const Vec3& shift, bool is_closed) {
    const auto has_same_place = [&](const MachineAction& left, const MachineAction& right) {
      if (left.kind != right.kind) return false;
      return left.is_motion() ? ends_together(runs_, left, right, shift) : is_same_effect(runs_, left, right);
    };
    const auto goes_same_way = [&](const MachineAction& left, const MachineAction& right) {
      if (!left.is_motion() || !right.is_motion()) return false;
      const Vec3 old_way = left.to.tip - left.from.tip;
      const Vec3 new_way = right.to.tip - right.from.tip;
      return (old_way - new_way).norm() <= options_.tolerance && left.from.b == left.to.b && left.from.c == left.to.c &&
             right.from.b == right.to.b && right.from.c == right.to.c &&
             (left.arc == MachineAction::kNone) == (right.arc == MachineAction::kNone);
    };
    const ActionRanges inner = trimmed(at);
    if (is_permutation(inner, has_same_place)) {
      add(ChangeKind::Reordered, inner);
      return true;
    }
    if (!is_closed || gap.shift != shift) return false;
    const ActionRanges closed{at.a_begin, at.a_end + 1, at.b_begin, at.b_end + 1};
    if (!is_permutation(closed, goes_same_way)) return false;
    add(ChangeKind::Reordered, closed);
    return true;
  }

  /// Names a part of a gap in which nothing is the same. `is_closed`: a motion to the same place follows.
  void name_part(const ActionRanges& at, const std::vector<GapStep>& steps, const Vec3& shift, bool is_closed) {
    std::size_t i = at.a_begin;
    std::size_t k = at.b_begin;
    for (const GapStep step : steps) {
      const bool has_a = step != GapStep::OnlyInB;
      const bool has_b = step != GapStep::OnlyInA;
      const MachineAction& either = has_a ? a(i) : b(k);
      if (!either.is_motion() && step != GapStep::Same) name_effect({i, i + has_a, k, k + has_b});
      if (has_a && has_b && either.is_motion() && !a(i).is_inverse_time) compare_feeds(i, k);
      i += has_a;
      k += has_b;
    }
    name_motions(at, shift, is_closed);
  }

  void name_effect(const ActionRanges& at) {
    const bool has_old = at.a_begin < at.a_end;
    const bool has_new = at.b_begin < at.b_end;
    const ActionKind kind = has_old ? a(at.a_begin).kind : b(at.b_begin).kind;
    const bool is_time = kind == ActionKind::Dwell || kind == ActionKind::ExactStop;
    if ((options_.ignores_time && is_time) || (options_.ignores_speed && kind == ActionKind::Spindle)) return;
    BehaviorChange& change = add(kind_of(kind), at);
    if (has_old) change.old_value = value_of(runs_.a, a(at.a_begin));
    if (has_new) change.new_value = value_of(runs_.b, b(at.b_begin));
  }

  /// The range from the first to the last motion.
  static std::pair<std::size_t, std::size_t> between_motions(const RecordedRun& run, std::size_t begin,
                                                             std::size_t end) {
    while (begin < end && !run.actions[begin].is_motion()) ++begin;
    while (end > begin && !run.actions[end - 1].is_motion()) --end;
    return {begin, end};
  }

  /// By how much all motions are moved, if it is the same.
  std::optional<Vec3> common_shift(const ActionRanges& at) const {
    std::optional<Vec3> common;
    if (at.a_end - at.a_begin != at.b_end - at.b_begin) return std::nullopt;
    for (std::size_t i = at.a_begin, k = at.b_begin; i < at.a_end; ++i, ++k) {
      if (a(i).is_motion() != b(k).is_motion()) return std::nullopt;
      if (!a(i).is_motion()) continue;
      const Vec3 shift = b(k).to.tip - a(i).to.tip;
      if (!common) common = shift;
      if ((shift - *common).norm() > options_.tolerance) return std::nullopt;
      const bool is_arc = a(i).arc != MachineAction::kNone;
      if (is_arc != (b(k).arc != MachineAction::kNone)) return std::nullopt;
      if (is_arc &&
          (runs_.b.arcs[b(k).arc].center - runs_.a.arcs[a(i).arc].center - *common).norm() > options_.tolerance)
        return std::nullopt;
      if (std::abs(a(i).to.b - b(k).to.b) > options_.tolerance || std::abs(a(i).to.c - b(k).to.c) > options_.tolerance)
        return std::nullopt;
    }
    return common;
  }

  double turned(const ActionRanges& at) const {
    double turned = 0;
    for (std::size_t i = at.a_begin, k = at.b_begin; i < at.a_end && k < at.b_end; ++i, ++k)
      if (a(i).is_motion() && b(k).is_motion())
        turned = std::max({turned, std::abs(a(i).to.b - b(k).to.b), std::abs(a(i).to.c - b(k).to.c)});
    return turned > options_.tolerance ? turned : 0;
  }

  void name_motions(const ActionRanges& whole, const Vec3& shift, bool is_closed) {
    ActionRanges at;
    std::tie(at.a_begin, at.a_end) = between_motions(runs_.a, whole.a_begin, whole.a_end);
    std::tie(at.b_begin, at.b_end) = between_motions(runs_.b, whole.b_begin, whole.b_end);
    const bool has_old = at.a_begin < at.a_end;
    const bool has_new = at.b_begin < at.b_end;
    if (!has_old && !has_new) return;
    if (!has_old || !has_new) {
      add(has_new ? ChangeKind::Added : ChangeKind::Removed, at);
      return;
    }
    const bool is_moved = motions(runs_.a, at.a_begin, at.a_end) == motions(runs_.b, at.b_begin, at.b_end);
    BehaviorChange& change = add(is_moved ? ChangeKind::Moved : ChangeKind::Shape, at);
    ActionRanges closed = at;
    if (is_closed && a(whole.a_end).is_motion() && b(whole.b_end).is_motion()) {
      closed.a_end = whole.a_end + 1;
      closed.b_end = whole.b_end + 1;
    }
    change.distance = shown_distance(closed, shift);
    if (!is_moved) return;
    change.shift = common_shift(at);
    change.turned = turned(at);
    if (change.shift && change.shift->norm() <= options_.tolerance) change.shift.reset();
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
      if (left.kind != right.kind) return false;
      if (left.is_motion() ? !ends_together(runs_, left, right, Vec3::Zero()) : !is_same_effect(runs_, left, right))
        return false;
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

/// The change as it is if both programs are swapped.
BehaviorChange mirrored(BehaviorChange change) {
  std::swap(change.old_lines, change.new_lines);
  std::swap(change.old_value, change.new_value);
  std::swap(change.old_motions, change.new_motions);
  if (change.shift) change.shift = -*change.shift;
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
  const bool is_swapped = is_before(new_run, old_run);
  const RunPair runs{is_swapped ? new_run : old_run, is_swapped ? old_run : new_run, options.tolerance};
  std::vector<BehaviorChange> changes = ChangeNamer(runs, options).changes(align(runs));
  if (!is_swapped) return changes;
  for (BehaviorChange& change : changes) change = mirrored(std::move(change));
  return changes;
}

}  // namespace isocnc::comparison
