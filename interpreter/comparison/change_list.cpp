#include "interpreter/comparison/change_list.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "interpreter/comparison/action_path.h"
#include "interpreter/comparison/gap_steps.h"
#include "interpreter/dialect/format.h"

namespace isocnc::comparison {

using geometry::Vec3;

namespace {

/// How many times as far as the paths are apart motions may end from those that are the same.
constexpr double kBeside = 2;
constexpr double kSameFeed = 1e-4;  ///< Relative: what F loses where it is written in inches or under G93.

std::string shown(double number) { return dialect::written_number(number, 4); }

/// What comes after the last action comes where that is.
std::size_t start_of(const RecordedRun& run, std::size_t begin) {
  return run.actions[std::min(begin, run.actions.size() - 1)].line;
}

/// As programs write it; empty for none.
std::string side_of(const MachineAction& motion) {
  return motion.side == 0 ? "" : fmt::format("G{}{}", motion.side, motion.reduces ? " G39" : "");
}

/// As programs write it.
std::string written(const timing::SpindleMotion& spindle) {
  return spindle.function == 5 ? "M05" : fmt::format("S{} M{:02}", shown(spindle.speed), spindle.function);
}

bool is_same_feed(const MachineAction& a, const MachineAction& b) {
  if (a.is_rapid != b.is_rapid) return false;
  const auto near = [](double one, double other) {
    return std::abs(one - other) <= kSameFeed * std::max(std::abs(one), std::abs(other));
  };
  return near(a.feed, b.feed) || (a.is_inverse_time && b.is_inverse_time && near(a.value, b.value));
}

}  // namespace

std::optional<ChangedLines> lines_of(const RecordedRun& run, std::size_t begin, std::size_t end) {
  if (begin == end) return std::nullopt;
  ChangedLines lines{run.actions[begin].line, run.actions[begin].line};
  for (std::size_t i = begin; i < end; ++i) {
    lines.first = std::min<std::size_t>(lines.first, run.actions[i].line);
    lines.last = std::max<std::size_t>(lines.last, run.actions[i].line);
  }
  return lines;
}

bool is_same_alone(const RunPair& runs, const ComparisonOptions& options, const MachineAction& a,
                   const MachineAction& b) {
  if (!is_same_action(runs, a, b, Vec3::Zero()) || a.side != b.side) return false;
  return !a.is_motion() || options.ignores_feed || is_same_feed(a, b);
}

std::size_t motion_count(const RecordedRun& run, std::size_t begin, std::size_t end) {
  const std::span actions = std::span(run.actions).subspan(begin, end - begin);
  return static_cast<std::size_t>(
      std::count_if(actions.begin(), actions.end(), [](const MachineAction& each) { return each.is_motion(); }));
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
      if (action.number == 0) return "S" + shown(action.value);
      return written({static_cast<int>(action.number), action.value});
    case ActionKind::Function: {
      const running::FunctionEvent& function = run.functions[action.number];
      std::string text = fmt::format("M{:02}", function.number);
      for (const execution::FunctionParameter& parameter : function.parameters)
        text += fmt::format(" P{}={}", parameter.number, dialect::written_number(parameter.value, 6));
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

std::optional<execution::ToolCode> tool_of(const RecordedRun& run, const MachineAction& action) {
  return action.tool == MachineAction::kNone ? std::nullopt : std::optional(run.tools[action.tool].code);
}

ChangeList::ChangeList(const RunPair& runs, const ComparisonOptions& options) : runs_(runs), options_(options) {}

double seconds_of(const RecordedRun& run, std::size_t begin, std::size_t end) {
  return begin < end ? run.actions[std::min(end, run.actions.size() - 1)].start - run.actions[begin].start : 0;
}

BehaviorChange ChangeList::measured_change(ChangeKind kind, const ActionRanges& at) const {
  BehaviorChange change{
      .kind = kind,
      .old_lines = lines_of(runs_.a, at.a_begin, at.a_end),
      .new_lines = lines_of(runs_.b, at.b_begin, at.b_end),
      .old_start = start_of(runs_.a, at.a_begin),
      .new_start = start_of(runs_.b, at.b_begin),
      .seconds = seconds_of(runs_.b, at.b_begin, at.b_end) - seconds_of(runs_.a, at.a_begin, at.a_end),
      .old_motions = motion_count(runs_.a, at.a_begin, at.a_end),
      .new_motions = motion_count(runs_.b, at.b_begin, at.b_end)};
  if (at.a_begin < at.a_end) change.old_tool = tool_of(runs_.a, a(at.a_begin));
  if (at.b_begin < at.b_end) change.new_tool = tool_of(runs_.b, b(at.b_begin));
  return change;
}

BehaviorChange& ChangeList::add(ChangeKind kind, const ActionRanges& at) {
  places_.push_back(at);
  return changes_.emplace_back(measured_change(kind, at));
}

void ChangeList::follow_shift(const ActionRanges& at, const Vec3& shift) {
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

/// The lines that have made two frames different: those of their zeros, if these differ. None for what is in force at
/// the start.
ChangeList::FrameCause ChangeList::cause_of(const MachineAction& left, const MachineAction& right) const {
  const ActionFrame& old_frame = runs_.a.frames[left.frame];
  const ActionFrame& new_frame = runs_.b.frames[right.frame];
  if ((new_frame.zero - old_frame.zero).norm() > options_.tolerance) return {old_frame.zero_line, new_frame.zero_line};
  const auto line_of = [](const ActionFrame& frame, std::uint32_t index) {
    return index == 0 ? std::nullopt : std::optional(frame.line);
  };
  return {line_of(old_frame, left.frame), line_of(new_frame, right.frame)};
}

/// Whether the frames in force in both differ by just this vector.
bool ChangeList::is_shift_of_frame(const MachineAction& left, const MachineAction& right, const Vec3& shift) const {
  const geometry::Frame& old_frame = runs_.a.frames[left.frame].frame;
  const geometry::Frame& new_frame = runs_.b.frames[right.frame].frame;
  return (new_frame.origin - old_frame.origin - shift).norm() <= options_.tolerance &&
         old_frame.axes.isApprox(new_frame.axes);
}

/// Whether the same frame is in force in both.
bool ChangeList::has_same_frame(const MachineAction& left, const MachineAction& right) const {
  return is_shift_of_frame(left, right, Vec3::Zero());
}

/// The first actions of a shifted range, up to those that another frame moves, by the same vector.
ActionRanges ChangeList::up_to_next_frame(const OpenShift& open) const {
  const ActionRanges& all = open.actions;
  if (all.a_end - all.a_begin != all.b_end - all.b_begin) return all;
  const FrameCause cause = cause_of(a(all.a_begin), b(all.b_begin));
  ActionRanges first{all.a_begin, all.a_begin, all.b_begin, all.b_begin};
  for (std::size_t i = all.a_begin, k = all.b_begin; i < all.a_end; ++i, ++k) {
    if (!a(i).is_motion() || !b(k).is_motion()) continue;
    if (cause_of(a(i), b(k)) != cause && is_shift_of_frame(a(i), b(k), open.shift)) return first;
    first.a_end = i + 1;
    first.b_end = k + 1;
  }
  return all;
}

void ChangeList::close_shift() {
  while (shift_) {
    const OpenShift open = *std::exchange(shift_, std::nullopt);
    const MachineAction& left = a(open.actions.a_begin);
    const MachineAction& right = b(open.actions.b_begin);
    const bool is_frame = is_shift_of_frame(left, right, open.shift);
    const ActionRanges at = is_frame ? up_to_next_frame(open) : open.actions;
    BehaviorChange& change = add(is_frame ? ChangeKind::Frame : ChangeKind::Moved, at);
    change.distance = open.shift.norm();
    change.shift = open.shift;
    if (!is_frame) return;
    const FrameCause cause = cause_of(left, right);
    change.old_cause = cause.old_line;
    change.new_cause = cause.new_line;
    OpenShift rest{{at.a_end, open.actions.a_end, at.b_end, open.actions.b_end}, open.shift};
    while (rest.actions.a_begin < rest.actions.a_end && !a(rest.actions.a_begin).is_motion())
      ++rest.actions.a_begin, ++rest.actions.b_begin;
    if (rest.actions.a_begin < rest.actions.a_end) shift_ = rest;
  }
}

void ChangeList::compare_feeds(std::size_t i, std::size_t k) {
  compare_feeds(i, k, {}, {}, std::numeric_limits<double>::infinity());
}

void ChangeList::compare_feeds(std::size_t i, std::size_t k, const OutsideParts& of_a, const OutsideParts& of_b,
                               double length) {
  const MachineAction& left = a(i);
  const MachineAction& right = b(k);
  if (!left.is_motion() || !right.is_motion()) return;
  compare_spindles(i, k);
  if (options_.ignores_feed && left.is_rapid == right.is_rapid) return;
  if (is_same_feed(left, right)) {
    if (!left.is_rapid) close_feed();
    return;
  }
  follow_value(feed_, ChangeKind::Feed,
               {{i, i + 1, k, k + 1}, value_of(runs_.a, left), value_of(runs_.b, right), of_a, of_b, length});
}

void ChangeList::compare_sides(std::size_t i, std::size_t k) {
  const MachineAction& left = a(i);
  const MachineAction& right = b(k);
  if (!left.has_side || !right.has_side) return;
  const auto is_by_control = [](const MachineAction& motion) { return motion.side != 0 && !motion.is_compensated; };
  const bool is_same = left.side == right.side && left.reduces == right.reduces;
  if (is_same || (!is_by_control(left) && !is_by_control(right))) return close_side();
  follow_value(side_, ChangeKind::Function, {{i, i + 1, k, k + 1}, side_of(left), side_of(right)});
}

void ChangeList::compare_spindles(std::size_t i, std::size_t k) {
  const MachineAction& left = a(i);
  const MachineAction& right = b(k);
  if (left.is_rapid || right.is_rapid) return;
  if (runs_.a.spindles[left.spindle].motion == runs_.b.spindles[right.spindle].motion) return;
  if (spindle_stretches_.empty() || spindle_stretches_.back().a_spindle != left.spindle ||
      spindle_stretches_.back().b_spindle != right.spindle) {
    spindle_stretches_.push_back({{i, i + 1, k, k + 1}, left.spindle, right.spindle});
    return;
  }
  ActionRanges& at = spindle_stretches_.back().actions;
  at = {std::min(at.a_begin, i), std::max(at.a_end, i + 1), std::min(at.b_begin, k), std::max(at.b_end, k + 1)};
}

/// Where the spindle turns otherwise though each S, M03, M04 and M05 is there, as before a tool change, which stops it.
void ChangeList::name_spindles() {
  std::map<std::size_t, std::size_t> named_in_a;  // The change that names an action.
  std::map<std::size_t, std::size_t> named_in_b;
  for (std::size_t i = 0; i < changes_.size(); ++i) {
    if (changes_[i].kind != ChangeKind::Speed) continue;
    for (std::size_t k = places_[i].a_begin; k < places_[i].a_end; ++k) named_in_a[k] = i;
    for (std::size_t k = places_[i].b_begin; k < places_[i].b_end; ++k) named_in_b[k] = i;
  }
  const auto name_of_cause = [](const ActionSpindle& spindle, const std::map<std::size_t, std::size_t>& named) {
    const auto found = spindle.cause ? named.find(*spindle.cause) : named.end();
    return found == named.end() ? std::nullopt : std::optional(found->second);
  };
  // Another speed in the place of one says nothing about what something else than that speed does later.
  const auto says_all = [&](const std::optional<std::size_t>& change, bool has_other) {
    if (!change) return false;
    const BehaviorChange& speed = changes_[*change];
    return has_other || speed.old_value.empty() || speed.new_value.empty() || speed.later != 0;
  };
  for (const SpindleStretch& stretch : spindle_stretches_) {
    const ActionSpindle& old_spindle = runs_.a.spindles[stretch.a_spindle];
    const ActionSpindle& new_spindle = runs_.b.spindles[stretch.b_spindle];
    const std::optional<std::size_t> of_a = name_of_cause(old_spindle, named_in_a);
    const std::optional<std::size_t> of_b = name_of_cause(new_spindle, named_in_b);
    if (says_all(of_a, of_b.has_value()) || says_all(of_b, of_a.has_value())) continue;
    BehaviorChange& change = add(ChangeKind::Speed, stretch.actions);
    change.old_value = written(old_spindle.motion);
    change.new_value = written(new_spindle.motion);
  }
}

void ChangeList::follow_value(std::optional<OpenValue>& open, ChangeKind kind, OpenValue next) {
  if (!open || open->old_value != next.old_value || open->new_value != next.new_value) {
    close(open, kind);
    open = std::move(next);
    return;
  }
  open->actions.a_end = next.actions.a_end;
  open->actions.b_end = next.actions.b_end;
  open->of_a.last = next.of_a.last;
  open->of_b.last = next.of_b.last;
  open->length += next.length;
}

/// Compares the motions that go along each other in one step; where that is one of each, no length is needed.
void ChangeList::compare_overlaps() {
  if (overlaps_.size() == 1) {
    compare_feeds(overlaps_[0].first, overlaps_[0].second);
    return compare_sides(overlaps_[0].first, overlaps_[0].second);
  }
  double from = 0;
  double a_from = 0;  // Where the motions of this overlap begin, along the path of the step.
  double b_from = 0;
  for (std::size_t n = 0; n < overlaps_.size(); ++n) {
    const auto& [i, k] = overlaps_[n];
    const double a_length = ActionPath(runs_.a, a(i)).length();
    const double b_length = ActionPath(runs_.b, b(k)).length();
    const double until = std::min(a_from + a_length, b_from + b_length);
    const auto outside = [&](double begin, double length) {
      return length > 0 ? OutsideParts{std::clamp((from - begin) / length, 0.0, 1.0),
                                       std::clamp((begin + length - until) / length, 0.0, 1.0)}
                        : OutsideParts{};
    };
    compare_feeds(i, k, outside(a_from, a_length), outside(b_from, b_length), until - from);
    compare_sides(i, k);
    from = until;
    if (n + 1 == overlaps_.size()) break;
    if (overlaps_[n + 1].first != i) a_from += a_length;
    if (overlaps_[n + 1].second != k) b_from += b_length;
  }
}

void ChangeList::compare_feeds_along(const AlignedPiece& piece) {
  for (PlaceInBoth place{piece.a_begin, piece.b_begin}; place.a < piece.a_end;) {
    overlaps_.clear();
    const auto next =
        same_step(runs_, place, piece.shift, [&](std::size_t i, std::size_t k) { overlaps_.emplace_back(i, k); });
    compare_overlaps();
    place = next.value_or(PlaceInBoth{place.a + 1, place.b + 1});
  }
}

void ChangeList::compare_feeds_alone(std::size_t i, std::size_t k) {
  close_feed();
  close_side();
  compare_feeds(i, k);
  compare_sides(i, k);
  close_feed();
  close_side();
}

void ChangeList::close(std::optional<OpenValue>& open, ChangeKind kind) {
  if (!open) return;
  OpenValue closed = std::move(*std::exchange(open, std::nullopt));
  // From there to there is the same place.
  if (closed.length <= options_.tolerance) return;
  BehaviorChange& change = add(kind, closed.actions);
  const auto outside = [](const RecordedRun& run, std::size_t begin, std::size_t end, const OutsideParts& parts) {
    return parts.first * seconds_of(run, begin, begin + 1) + parts.last * seconds_of(run, end - 1, end);
  };
  change.seconds += outside(runs_.a, closed.actions.a_begin, closed.actions.a_end, closed.of_a) -
                    outside(runs_.b, closed.actions.b_begin, closed.actions.b_end, closed.of_b);
  change.old_value = std::move(closed.old_value);
  change.new_value = std::move(closed.new_value);
}

std::vector<BehaviorChange> ChangeList::take() {
  close_shift();
  close_feed();
  close_side();
  name_frames();
  join_moved_rows();
  join_paths_beside();
  join_moved_blocks();
  name_exchanged_blocks();
  name_spindles();
  remove_idle_stops();
  for (auto& [change, place] : operations_) {
    changes_.push_back(std::move(change));
    places_.push_back(place);
  }
  sort();
  return std::move(changes_);
}

/// Where a spindle no longer starts, or starts in one program alone, the M05 after it stops nothing; nor does one after
/// motions in which the spindle of the other program stands.
void ChangeList::remove_idle_stops() {
  const auto is_alone = [&](std::size_t change, bool is_old) {
    const BehaviorChange& speed = changes_[change];
    return speed.kind == ChangeKind::Speed && speed.later == 0 && (is_old ? speed.new_value : speed.old_value).empty();
  };
  std::vector<bool> is_idle(changes_.size());
  for (const bool is_old : {true, false}) {
    const RecordedRun& run = is_old ? runs_.a : runs_.b;
    std::set<std::uint32_t> beside_stillness;  // How it turns while that of the other program stands.
    for (const SpindleStretch& stretch : spindle_stretches_) {
      const std::uint32_t other = is_old ? stretch.b_spindle : stretch.a_spindle;
      if ((is_old ? runs_.b : runs_.a).spindles[other].motion.function == 5)
        beside_stillness.insert(is_old ? stretch.a_spindle : stretch.b_spindle);
    }
    std::map<std::size_t, std::size_t> alone;  // By the action.
    for (std::size_t i = 0; i < changes_.size(); ++i)
      if (is_alone(i, is_old)) alone[is_old ? places_[i].a_begin : places_[i].b_begin] = i;
    for (const auto& [action, change] : alone) {
      if (run.actions[action].number != 5) continue;
      const std::uint32_t turned = run.actions[action].spindle - 1;  // An M05 is an action where the spindle turns.
      const std::optional<std::size_t>& start = run.spindles[turned].cause;
      const bool is_started_alone = start && alone.contains(*start) && run.spindles[turned - 1].motion.function == 5;
      is_idle[change] = beside_stillness.contains(turned) || is_started_alone;
    }
  }
  remove(is_idle);
}

void ChangeList::add_operation(BehaviorChange change, const ActionRanges& place) {
  operations_.emplace_back(std::move(change), place);
}

/// Whether two motions are the same, each in the frame that is in force there. Coordinates that neither of them gives
/// remain where the motions start.
bool ChangeList::is_by_frames(const MachineAction& left, const MachineAction& right) const {
  if (!left.is_motion() || !right.is_motion()) return false;
  const geometry::Frame& old_frame = runs_.a.frames[left.frame].frame;
  const geometry::Frame& new_frame = runs_.b.frames[right.frame].frame;
  const auto is_same = [&](const Vec3& from_a, const Vec3& from_b) {
    return (new_frame.to_outer(old_frame.to_inner(from_a)) - from_b).norm() <= options_.tolerance;
  };
  if (std::max(std::abs(left.to.b - right.to.b), std::abs(left.to.c - right.to.c)) > options_.tolerance) return false;
  const Vec3 old_from = old_frame.to_inner(left.from.tip);
  const Vec3 new_from = new_frame.to_inner(right.from.tip);
  const Vec3 old_to = old_frame.to_inner(left.to.tip);
  const Vec3 new_to = new_frame.to_inner(right.to.tip);
  for (int axis = 0; axis < 3; ++axis) {
    const auto differ = [&](double one, double other) { return std::abs(one - other) > options_.tolerance; };
    const bool is_kept = !differ(old_from[axis], old_to[axis]) && !differ(new_from[axis], new_to[axis]);
    if (!is_kept && differ(old_to[axis], new_to[axis])) return false;
  }
  const bool is_arc = left.arc != MachineAction::kNone;
  if (!is_arc || right.arc == MachineAction::kNone) return is_arc == (right.arc != MachineAction::kNone);
  const ActionArc& left_arc = runs_.a.arcs[left.arc];
  const ActionArc& right_arc = runs_.b.arcs[right.arc];
  const Vec3 normal = new_frame.axes * old_frame.axes.transpose() * left_arc.normal;
  const double turn = std::abs(left_arc.sweep_deg - right_arc.sweep_deg) / 180 * std::numbers::pi;
  return is_same(left_arc.center, right_arc.center) && is_same(left.from.tip, right.from.tip) &&
         normal.isApprox(right_arc.normal) && turn * (left.from.tip - left_arc.center).norm() <= options_.tolerance;
}

bool ChangeList::is_moved_by_frame(std::size_t i, std::size_t k) const {
  return !has_same_frame(a(i), b(k)) && is_by_frames(a(i), b(k));
}

/// What frames make different in a range, if that is all: each motion starts where both are together or where the
/// frames lead, and is the same in its frame. None for two causes.
std::optional<ChangeList::FrameChange> ChangeList::by_frames(const ActionRanges& at) const {
  if (at.a_begin == at.a_end || at.a_end - at.a_begin != at.b_end - at.b_begin) return std::nullopt;
  std::optional<FrameChange> found;
  for (std::size_t i = at.a_begin, k = at.b_begin; i < at.a_end; ++i, ++k) {
    const MachineAction& left = a(i);
    const MachineAction& right = b(k);
    if (!left.is_motion() && !right.is_motion()) {
      if (!is_same_effect(runs_, left, right)) return std::nullopt;
      continue;
    }
    if (!is_by_frames(left, right)) return std::nullopt;
    if (has_same_frame(left, right)) {
      if (!found) return std::nullopt;  // What comes before it moves it.
      continue;
    }
    const geometry::Frame& old_frame = runs_.a.frames[left.frame].frame;
    const geometry::Frame& new_frame = runs_.b.frames[right.frame].frame;
    const bool is_turned = !old_frame.axes.isApprox(new_frame.axes);
    const FrameChange next{cause_of(left, right), new_frame.origin - old_frame.origin, is_turned};
    if (!found) found = next;
    if (found->cause != next.cause || found->is_turned != next.is_turned ||
        (!is_turned && (found->shift - next.shift).norm() > options_.tolerance))
      return std::nullopt;
  }
  return found;
}

/// What a frame moves is one change: in one that is turned, each motion is moved otherwise, and under one that is
/// shifted a motion that gives one coordinate is moved along that one alone.
void ChangeList::name_frames() {
  struct Known {
    FrameChange frames;
    std::size_t change = 0;  ///< The first one.
  };
  std::vector<Known> known;
  std::vector<bool> is_joined(changes_.size());
  const auto key = [&](std::size_t i) { return std::pair(places_[i].a_begin, places_[i].b_begin); };
  std::vector<std::size_t> order(changes_.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](auto left, auto right) { return key(left) < key(right); });
  for (const std::size_t i : order) {
    BehaviorChange& change = changes_[i];
    const ActionRanges at = places_[i];
    std::optional<FrameChange> frames;
    if (change.kind == ChangeKind::Frame) frames = FrameChange{{change.old_cause, change.new_cause}, *change.shift};
    if (change.kind == ChangeKind::Moved || change.kind == ChangeKind::Shape) frames = by_frames(at);
    if (!frames) continue;
    const auto first = std::find_if(known.begin(), known.end(), [&](const Known& each) {
      return each.frames.cause == frames->cause && each.frames.is_turned == frames->is_turned &&
             (frames->is_turned || (each.frames.shift - frames->shift).norm() <= options_.tolerance);
    });
    if (frames->is_turned && at.a_end - at.a_begin == at.b_end - at.b_begin)
      for (std::size_t m = at.a_begin, n = at.b_begin; m < at.a_end; ++m, ++n)
        if (a(m).is_motion()) change.end_distance = std::max(change.end_distance, (b(n).to.tip - a(m).to.tip).norm());
    if (first == known.end()) {
      known.push_back({*frames, i});
      change.kind = ChangeKind::Frame;
      change.shift.reset();
      change.old_cause = frames->cause.old_line;
      change.new_cause = frames->cause.new_line;
      if (frames->is_turned) continue;
      change.shift = frames->shift;
      change.distance = frames->shift.norm();
      change.end_distance = 0;
      continue;
    }
    is_joined[i] = true;
    BehaviorChange& whole = changes_[first->change];
    ActionRanges& all = places_[first->change];
    all = {std::min(all.a_begin, at.a_begin), std::max(all.a_end, at.a_end), std::min(all.b_begin, at.b_begin),
           std::max(all.b_end, at.b_end)};
    if (!frames->is_turned) continue;
    whole.end_distance = std::max(whole.end_distance, change.end_distance);
    whole.distance =
        whole.distance && change.distance ? std::optional(std::max(*whole.distance, *change.distance)) : std::nullopt;
  }
  for (const auto& [frames, first] : known) {
    BehaviorChange& whole = changes_[first];
    const ActionRanges& all = places_[first];
    whole.old_lines = lines_of(runs_.a, all.a_begin, all.a_end);
    whole.new_lines = lines_of(runs_.b, all.b_begin, all.b_end);
    whole.old_motions = motion_count(runs_.a, all.a_begin, all.a_end);
    whole.new_motions = motion_count(runs_.b, all.b_begin, all.b_end);
  }
  remove(is_joined);
}

/// Whether the motions of a change go on from those of another one, moved a bit otherwise. Two edits that move what
/// follows them by different vectors remain two.
bool ChangeList::is_one_row(std::size_t first, std::size_t next) const {
  const ActionRanges& one = places_[first];
  const ActionRanges& other = places_[next];
  const auto has_nothing = [](const RecordedRun& run, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (run.actions[i].is_motion() || run.actions[i].kind == ActionKind::Tool) return false;
    return begin <= end;
  };
  if (!has_nothing(runs_.a, one.a_end, other.a_begin) || !has_nothing(runs_.b, one.b_end, other.b_begin)) return false;
  const bool are_rows = changes_[first].shift && changes_[next].shift;
  const Vec3 before = changes_[first].shift.value_or(b(one.b_end - 1).to.tip - a(one.a_end - 1).to.tip);
  const Vec3 after = changes_[next].shift.value_or(b(other.b_begin).to.tip - a(other.a_begin).to.tip);
  constexpr double kBetweenRows = 4;  // A row ends where its vector is off by the tolerance.
  return (after - before).norm() <=
         kBetweenRows * options_.tolerance + (are_rows ? 0 : std::max(before.norm(), after.norm()) / 2);
}

/// Motions of which each is moved by another vector than the one before it fall into rows of those that are the same
/// within the tolerance. Together they are one change.
void ChangeList::join_moved_rows() {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < changes_.size(); ++i)
    if (changes_[i].kind == ChangeKind::Moved) rows.push_back(i);
  std::sort(rows.begin(), rows.end(),
            [&](std::size_t left, std::size_t right) { return places_[left].a_begin < places_[right].a_begin; });
  std::vector<bool> is_joined(changes_.size());
  for (std::size_t i = 1; i < rows.size(); ++i) is_joined[rows[i]] = is_one_row(rows[i - 1], rows[i]);
  for (std::size_t i = rows.size(); i-- > 1;) {
    const std::size_t first = rows[i - 1];
    const std::size_t next = rows[i];
    if (!is_joined[next]) continue;
    BehaviorChange& whole = changes_[first];
    const BehaviorChange& rest = changes_[next];
    ActionRanges& all = places_[first];
    all.a_end = places_[next].a_end;
    all.b_end = places_[next].b_end;
    // What turns and has no distance is nowhere else.
    const auto is_known = [](const BehaviorChange& change) { return change.distance || change.turned != 0; };
    const double farthest = std::max(whole.distance.value_or(0), rest.distance.value_or(0));
    whole.distance = is_known(whole) && is_known(rest) && farthest > 0 ? std::optional(farthest) : std::nullopt;
    whole.turned = std::max(whole.turned, rest.turned);
    whole.shift.reset();
    whole.old_lines = lines_of(runs_.a, all.a_begin, all.a_end);
    whole.new_lines = lines_of(runs_.b, all.b_begin, all.b_end);
    whole.old_motions = motion_count(runs_.a, all.a_begin, all.a_end);
    whole.new_motions = motion_count(runs_.b, all.b_begin, all.b_end);
  }
  remove(is_joined);
}

/// Whether a change says how the path differs, and by how much.
bool ChangeList::is_path(std::size_t change) const {
  const BehaviorChange& each = changes_[change];
  if (each.kind == ChangeKind::Added || each.kind == ChangeKind::Removed) return true;
  if (each.kind != ChangeKind::Moved && each.kind != ChangeKind::Shape) return false;
  return each.distance.value_or(0) > 0 && each.turned == 0;
}

/// Whether a change goes on where others end.
bool ChangeList::follows(const ActionRanges& all, const ActionRanges& next) const {
  const auto has_nothing = [](const RecordedRun& run, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (run.actions[i].is_motion() || run.actions[i].kind == ActionKind::Tool) return false;
    return true;
  };
  return next.b_begin >= all.b_begin && has_nothing(runs_.a, all.a_end, next.a_begin) &&
         has_nothing(runs_.b, all.b_end, next.b_begin);
}

/// Whether both paths go along each other, from the start of some ranges to the end of the motions that close them, and
/// go from rapid to feed in the same places; with `with_feeds`, from one feed to the other one, too. B and C rest.
bool ChangeList::goes_beside(const ActionRanges& all, double distance, bool with_feeds) const {
  struct FeedChange {
    Vec3 place;
    double feed = 0;
  };
  if (is_too_large(all.a_end - all.a_begin, all.b_end - all.b_begin)) return false;
  struct WholePath {
    std::vector<Vec3> chain;
    std::vector<FeedChange> feeds;
    geometry::Pose first;
    bool turns = false;
  };
  const bool is_closed = all.a_end < runs_.a.actions.size() && all.b_end < runs_.b.actions.size() &&
                         a(all.a_end).is_motion() && b(all.b_end).is_motion();
  const auto path_of = [&](const RecordedRun& run, std::size_t begin, std::size_t end) {
    const std::span actions = std::span(run.actions).subspan(begin, end - begin + (is_closed ? 1 : 0));
    WholePath path{chain_of(run, actions, distance / 8), {}, {}};
    double feed = -1;
    for (const MachineAction& action : actions) {
      if (!action.is_motion()) continue;
      if (feed < 0) path.first = action.from;
      for (const geometry::Pose& pose : {action.from, action.to})
        path.turns = path.turns ||
                     std::max(std::abs(pose.b - path.first.b), std::abs(pose.c - path.first.c)) > options_.tolerance;
      const double next = with_feeds || action.is_rapid ? action.feed : 1;
      if (feed < 0 || std::abs(next - feed) > kSameFeed * std::max(feed, next))
        path.feeds.push_back({action.from.tip, next});
      feed = next;
    }
    return path;
  };
  const WholePath of_a = path_of(runs_.a, all.a_begin, all.a_end);
  const WholePath of_b = path_of(runs_.b, all.b_begin, all.b_end);
  if (of_a.turns || of_b.turns || of_a.chain.empty() || of_b.chain.empty()) return false;
  if (std::max(std::abs(of_a.first.b - of_b.first.b), std::abs(of_a.first.c - of_b.first.c)) > options_.tolerance)
    return false;
  const auto is_same = [&](const FeedChange& left, const FeedChange& right) {
    return (left.place - right.place).norm() <= distance &&
           std::abs(left.feed - right.feed) <= kSameFeed * std::max(left.feed, right.feed);
  };
  if (!std::equal(of_a.feeds.begin(), of_a.feeds.end(), of_b.feeds.begin(), of_b.feeds.end(), is_same)) return false;
  if (is_too_large(of_a.chain.size(), of_b.chain.size())) return false;
  if (runs_.budget != nullptr) {
    const std::size_t cells = of_a.chain.size() * of_b.chain.size();
    if (cells > runs_.budget->distances) return false;
    runs_.budget->distances -= cells;
  }
  return goes_along(of_a.chain, of_b.chain, distance);
}

/// The motions that end beside each other, one of each, and by how much they do at most; none where they do not.
std::optional<std::pair<ActionRanges, double>> ChangeList::moved_ends(const ActionRanges& all, double farthest) const {
  if (all.a_end - all.a_begin != all.b_end - all.b_begin) return std::nullopt;
  ActionRanges moved = all;
  double end_distance = 0;
  for (std::size_t i = all.a_begin, k = all.b_begin; i < all.a_end; ++i, ++k) {
    if (!a(i).is_line() || !b(k).is_line()) return std::nullopt;
    const double distance = (b(k).to.tip - a(i).to.tip).norm();
    end_distance = std::max(end_distance, distance);
    // The first ones may end in the same place.
    if (distance <= options_.tolerance && moved.a_begin == i) ++moved.a_begin, ++moved.b_begin;
  }
  if (end_distance > farthest || end_distance <= options_.tolerance) return std::nullopt;
  while (ends_together(runs_, a(moved.a_end - 1), b(moved.b_end - 1), Vec3::Zero())) --moved.a_end, --moved.b_end;
  return std::pair(moved, end_distance);
}

/// Some ranges up to the motions that close them, one of each: a line may be in parts.
ActionRanges ChangeList::up_to_closing(ActionRanges all) const {
  constexpr std::size_t kMaxParts = 40;
  const auto is_there = [](const RecordedRun& run, std::size_t i) {
    return i < run.actions.size() && run.actions[i].is_motion();
  };
  for (std::size_t parts = 0; parts < kMaxParts; ++parts)
    for (std::size_t m = 0; m <= parts; ++m)
      for (const auto& [i, k] :
           {std::pair(all.a_end + parts, all.b_end + m), std::pair(all.a_end + m, all.b_end + parts)})
        if (is_there(runs_.a, i) && is_there(runs_.b, k) && ends_together(runs_, a(i), b(k), Vec3::Zero()))
          return {all.a_begin, i, all.b_begin, k};
  return all;
}

/// Whether changes that follow each other may come from taking the wrong motions for each other: none of them moves one
/// motion each by one vector, which is larger than what the tolerance makes of places beside each other, and other than
/// that of the motion before.
bool ChangeList::may_be_mistaken(std::span<const std::size_t> row) const {
  constexpr double kWithinTolerance = 4;
  const ActionRanges& first = places_[row.front()];
  const auto goes_on = [&](const ActionRanges& at, const Vec3& shift) {
    if (at.a_begin == 0 || at.b_begin == 0) return false;
    const MachineAction& left = a(at.a_begin - 1);
    const MachineAction& right = b(at.b_begin - 1);
    return left.is_motion() && right.is_motion() &&
           (right.to.tip - left.to.tip - shift).norm() <= kWithinTolerance * options_.tolerance;
  };
  return std::none_of(row.begin(), row.end(), [&](std::size_t i) {
    const ActionRanges& at = places_[i];
    return changes_[i].shift && !goes_on(at, *changes_[i].shift) &&
           changes_[i].shift->norm() > kWithinTolerance * options_.tolerance &&
           at.a_end - at.a_begin == at.b_end - at.b_begin && at.a_begin - first.a_begin == at.b_begin - first.b_begin;
  });
}

/// Makes one change of changes that follow each other, if both paths go along each other nearer than what is reported,
/// or if the motions end beside each other, one of each, not much farther: then the wrong ones have been taken for each
/// other.
bool ChangeList::join_path(std::span<const std::size_t> row, const ActionRanges& at, double reported) {
  const bool is_mistaken = may_be_mistaken(row);
  const double nearer = is_mistaken ? 0.75 : 0.5;
  const ActionRanges all = up_to_closing(at);
  const bool is_nearer = goes_beside(all, nearer * reported, false);
  const auto moved = moved_ends(all, is_nearer ? reported : kBeside * reported);
  if (!is_nearer && (!moved || !is_mistaken)) return false;
  const double deviation = options_.tolerance / 8;
  const auto chain = [&](const RecordedRun& run, std::size_t begin, std::size_t end) {
    const bool is_closed = end < run.actions.size() && run.actions[end].is_motion();
    return chain_of(run, std::span(run.actions).subspan(begin, end - begin + (is_closed ? 1 : 0)), deviation);
  };
  const std::optional<double> distance =
      distance_of(chain(runs_.a, all.a_begin, all.a_end), chain(runs_.b, all.b_begin, all.b_end), 2 * deviation,
                  runs_.budget == nullptr ? nullptr : &runs_.budget->distances);
  if (!distance) return false;
  places_[row.front()] = moved ? moved->first : all;
  BehaviorChange& change = changes_[row.front()];
  change = measured_change(moved ? ChangeKind::Moved : ChangeKind::Shape, places_[row.front()]);
  if (moved) change.end_distance = moved->second;
  change.distance = distance;
  return true;
}

/// Names another path as moved, if its motions end beside those of the other run, one of each.
void ChangeList::rename_moved(std::size_t change) {
  if (changes_[change].kind != ChangeKind::Shape) return;
  const auto moved = moved_ends(places_[change], kBeside * changes_[change].distance.value_or(0));
  if (!moved) return;
  const std::optional<double> distance = changes_[change].distance;
  places_[change] = moved->first;
  changes_[change] = measured_change(ChangeKind::Moved, moved->first);
  changes_[change].end_distance = moved->second;
  changes_[change].distance = distance;
}

/// Where motions are short, those of one run may be taken for neighbors of theirs. Changes that follow each other are
/// one where the paths or the ends are nearer to each other than what is reported; and none where the tolerance allows
/// all of it.
void ChangeList::join_paths_beside() {
  constexpr std::size_t kMaxRow = 64;
  struct PathRow {
    ActionRanges all;
    double reported = 0;
  };
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < changes_.size(); ++i)
    if (is_path(i)) order.push_back(i);
  const auto key = [&](std::size_t i) { return std::pair(places_[i].a_begin, places_[i].b_begin); };
  std::stable_sort(order.begin(), order.end(), [&](auto left, auto right) { return key(left) < key(right); });
  std::vector<bool> is_removed(changes_.size());
  for (std::size_t first = 0; first < order.size();) {
    std::vector<PathRow> rows;  // Up to each of the next changes.
    for (std::size_t next = first; next < order.size() && rows.size() < kMaxRow; ++next) {
      const BehaviorChange& change = changes_[order[next]];
      const ActionRanges& at = places_[order[next]];
      const double reported = std::max(change.distance.value_or(0), change.end_distance);
      if (rows.empty()) {
        rows.push_back({at, reported});
        continue;
      }
      const ActionRanges& all = rows.back().all;
      if (!follows(all, at)) break;
      rows.push_back({{all.a_begin, std::max(all.a_end, at.a_end), all.b_begin, std::max(all.b_end, at.b_end)},
                      std::max(rows.back().reported, reported)});
    }
    for (; !rows.empty(); rows.pop_back()) {
      const PathRow& row = rows.back();
      const bool is_one = rows.size() == 1;
      const BehaviorChange& change = changes_[order[first]];
      // The distance of one path from the other one says that they are not the same.
      const bool is_known = is_one && !change.shift && change.distance.value_or(0) > options_.tolerance;
      is_removed[order[first]] = !is_known && goes_beside(up_to_closing(row.all), options_.tolerance, true);
      if (is_removed[order[first]]) break;
      if (is_one) rename_moved(order[first]);
      if (!is_one && join_path(std::span(order).subspan(first, rows.size()), row.all, row.reported)) break;
    }
    for (std::size_t i = 1; i < rows.size(); ++i) is_removed[order[first + i]] = true;
    first += std::max<std::size_t>(rows.size(), 1);
  }
  remove(is_removed);
}

/// Motions that are removed in one place and added in another one have another order.
void ChangeList::join_moved_blocks() {
  constexpr std::size_t kMaxChanges = 2000;
  if (changes_.size() > kMaxChanges) return;
  std::vector<bool> is_joined(changes_.size());
  for (std::size_t i = 0; i < changes_.size(); ++i) {
    if (changes_[i].kind != ChangeKind::Removed) continue;
    for (std::size_t k = 0; k < changes_.size(); ++k) {
      if (changes_[k].kind != ChangeKind::Added || is_joined[k] || !is_same_block(places_[i], places_[k])) continue;
      BehaviorChange& change = changes_[i];
      change.kind = ChangeKind::Reordered;
      change.distance.reset();
      change.new_lines = changes_[k].new_lines;
      change.new_start = changes_[k].new_start;
      change.new_motions = changes_[k].new_motions;
      change.new_tool = changes_[k].new_tool;
      is_joined[k] = true;
      if (const auto retract = retract_after(places_[i], places_[k])) is_joined[*retract] = true;
      break;
    }
  }
  remove(is_joined);
}

/// The change of motions that go the same way as before from where what is removed or added ends: the retract after the
/// last hole.
std::optional<std::size_t> ChangeList::retract_after(const ActionRanges& removed, const ActionRanges& added) const {
  for (std::size_t i = 0; i < changes_.size(); ++i) {
    const ActionRanges& at = places_[i];
    if (changes_[i].kind != ChangeKind::Moved || !changes_[i].shift) continue;
    if (at.a_begin != removed.a_end && at.b_begin != added.b_end) continue;
    const Vec3 start = b(at.b_begin).from.tip - a(at.a_begin).from.tip;
    if ((start - *changes_[i].shift).norm() <= options_.tolerance) return i;
  }
  return std::nullopt;
}

/// Whether a range of one run has the actions of a range of the other one, in any order.
bool ChangeList::has_same_actions(const ActionRanges& of_a, const ActionRanges& of_b) const {
  constexpr std::size_t kMaxActions = 256;
  const std::size_t count = of_a.a_end - of_a.a_begin;
  if (of_b.b_end - of_b.b_begin != count || count > kMaxActions) return false;
  std::vector<bool> is_used(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto is_it = [&](std::size_t k) {
      return !is_used[k] && is_same_alone(runs_, options_, a(of_a.a_begin + i), b(of_b.b_begin + k));
    };
    std::size_t k = i;  // Most blocks keep the order of their actions.
    if (!is_it(k))
      for (k = 0; k < count && !is_it(k);) ++k;
    if (k == count) return false;
    is_used[k] = true;
  }
  return true;
}

/// Whether a moved block of the first run stands in the place of another one in the second run. What goes the same way
/// after one of them starts elsewhere and is no part of it: the retract after the last hole.
bool ChangeList::is_exchanged(std::size_t block, std::size_t place) const {
  ActionRanges of_a = places_[block];
  ActionRanges of_b = places_[place];
  const std::size_t a_count = of_a.a_end - of_a.a_begin;
  const std::size_t b_count = of_b.b_end - of_b.b_begin;
  constexpr std::size_t kMinBlock = 2;
  const std::size_t count = std::min(a_count, b_count);
  if (a_count != b_count && count < kMinBlock) return false;
  const ActionRanges& longer = places_[a_count > b_count ? block : place];
  for (std::size_t n = count; n < std::max(a_count, b_count); ++n) {
    const MachineAction& left = a(longer.a_begin + n);
    const MachineAction& right = b(longer.b_begin + n);
    const Vec3 other_way = (right.to.tip - right.from.tip) - (left.to.tip - left.from.tip);
    if (!left.is_line() || !right.is_line() || other_way.norm() > options_.tolerance) return false;
  }
  of_a.a_end = of_a.a_begin + count;
  of_b.b_end = of_b.b_begin + count;
  return has_same_actions(of_a, of_b);
}

/// Motions that end elsewhere because each of some blocks stands in the place of another one of them, as holes that are
/// exchanged, have another order.
void ChangeList::name_exchanged_blocks() {
  constexpr std::size_t kMaxChanges = 500;
  std::vector<std::size_t> moved;
  for (std::size_t i = 0; i < changes_.size(); ++i) {
    const ActionRanges& at = places_[i];
    if (changes_[i].kind == ChangeKind::Moved && at.a_end - at.a_begin == at.b_end - at.b_begin) moved.push_back(i);
  }
  if (moved.size() < 2 || moved.size() > kMaxChanges) return;
  std::vector<std::size_t> now(moved.size(), moved.size());  // In which place of `moved` each block is now.
  std::vector<bool> is_taken(moved.size());
  for (std::size_t i = 0; i < moved.size(); ++i)
    for (std::size_t k = 0; k < moved.size(); ++k) {
      if (k == i || is_taken[k] || !is_exchanged(moved[i], moved[k])) continue;
      now[i] = k;
      is_taken[k] = true;
      break;
    }
  const std::vector<ActionRanges> places = places_;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    // Around a circle: what stands in the place of each block is one of them, too.
    std::size_t k = now[i];
    for (std::size_t n = 0; n < moved.size() && k != i && k < moved.size(); ++n) k = now[k];
    if (k != i) continue;
    const ActionRanges& of_b = places[moved[now[i]]];
    ActionRanges& at = places_[moved[i]];
    const std::size_t count = std::min(at.a_end - at.a_begin, of_b.b_end - of_b.b_begin);
    at = {at.a_begin, at.a_begin + count, of_b.b_begin, of_b.b_begin + count};
    changes_[moved[i]] = measured_change(ChangeKind::Reordered, at);
  }
}

void ChangeList::remove(const std::vector<bool>& is_removed) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < changes_.size(); ++i) {
    if (is_removed[i]) continue;
    if (kept != i) changes_[kept] = std::move(changes_[i]);
    places_[kept++] = places_[i];
  }
  changes_.resize(kept);
  places_.resize(kept);
}

bool ChangeList::is_same_block(const ActionRanges& removed, const ActionRanges& added) const {
  const std::size_t count = removed.a_end - removed.a_begin;
  if (added.b_end - added.b_begin != count) return false;
  for (std::size_t i = 0; i < count; ++i)
    if (!is_same_alone(runs_, options_, a(removed.a_begin + i), b(added.b_begin + i))) return false;
  return true;
}

void ChangeList::sort() {
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

}  // namespace isocnc::comparison
