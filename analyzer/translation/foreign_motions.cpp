#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "analyzer/translation/translation_run.h"
#include "interpreter/geometry/arc.h"

namespace isocnc::translation {

using geometry::Vec3;
using Untranslatable = UntranslatableReason;
using enum ForeignRole;

static constexpr char kMotionAxes[] = {'X', 'Y', 'Z'};
static constexpr char kCenterLetters[] = {'I', 'J', 'K'};
static constexpr int kMaxTurns = 1000;

bool TranslationRun::has_motion(const CurrentBlock& current) const {
  if (!takes_place_as_motion(current) || current.has(Ignored)) return false;
  return current.has_any("XYZ") || current.has(Cycle) || (!holds_cycle() && current.has_any("IJKR"));
}

void TranslationRun::refuse_motion(CurrentBlock& current, std::optional<BlockRefusal> refusal) {
  if (refusal) report(current, std::move(*refusal));
  current.remark.clear();
  current.has_moved = true;  // What the block sets is written with the next motion.
  keep_as_comment(current);
  apply_feed(current);
  lose(current, false);
}

void TranslationRun::add_motion(CurrentBlock& current) {
  const ForeignWord& first = *std::find_if(current.words.begin(), current.words.end(), [](const ForeignWord& word) {
    return std::string_view("GXYZIJKR").find(word.letter) != std::string_view::npos;
  });
  if (current.has(MachineCoordinates)) return move_in_machine(current);
  if (motion_ < 0) return refuse_motion(current, BlockRefusal{Untranslatable::NoMotionInForce, first.at, {}});
  if (holds_cycle()) return drill(current);
  if (motion_ >= 2) return move_along_arc(current);
  move_straight(current);
}

/// The motion is a feed move, or a rapid. If it cannot be made, the block stays as a comment.
bool TranslationRun::may_move(CurrentBlock& current, bool feeds) {
  const auto refused = [&](std::optional<BlockRefusal> refusal) {
    refuse_motion(current, std::move(refusal));
    return false;
  };
  const std::size_t at = current.words.empty() ? 0 : current.words.front().at;
  if (!has_tool(current)) return false;
  if (!frames_.has_zero()) {
    const bool is_first = said_once_.insert(Untranslatable::ZeroPointMissing).second;
    return refused(is_first ? std::optional(BlockRefusal{Untranslatable::ZeroPointMissing, at, {"G54"}})
                            : std::nullopt);
  }
  const auto stops_motions = [&](ForeignRole role) { return role != SurfaceSpeed && (role != PerTurn || feeds); };
  const bool is_suspended = std::any_of(suspended_by_.begin(), suspended_by_.end(), stops_motions);
  if (is_suspended || unknown_.contains(UnknownMode::ExternalShift)) return refused({});
  std::set needed{UnknownMode::Units, UnknownMode::Distance, UnknownMode::ZeroPoint, UnknownMode::Shift,
                  UnknownMode::LocalShift};
  if (feeds) needed.insert(UnknownMode::FeedMode);
  if (compensation_ != 40 || (feeds && motion_ >= 2)) needed.insert(UnknownMode::Plane);
  if (current.has_any("IJK")) needed.insert(UnknownMode::Centers);
  if (holds_cycle()) needed.insert(UnknownMode::Retract);
  if (lacks(needed)) return refused(missing_modes(needed, at));
  const ForeignWord* const z = current.find('Z');
  if (length_off_ && z != nullptr) return refused(BlockRefusal{Untranslatable::LengthOff, z->at, {}});
  if (!turned_by_.empty()) {
    const bool gives_both = !now_.incremental && current.find(kMotionAxes[turned_plane_.u]) != nullptr &&
                            current.find(kMotionAxes[turned_plane_.v]) != nullptr;
    if (!gives_both) return refused(BlockRefusal{Untranslatable::AxesAfterRotation, at, {turned_by_}});
  }
  const auto lost_axes = std::count(lost_.begin(), lost_.end(), true);
  const bool lacks_height_alone = lost_axes == 1 && left_by_cycle_ >= 0;
  const bool drills_on = lacks_height_alone && holds_cycle() && foreign_plane(now_.plane).normal == left_by_cycle_;
  if (lost_axes > 0 && (now_.incremental || (feeds && !drills_on)))
    return refused(
        BlockRefusal{lacks_height_alone ? Untranslatable::RetractUnstated : Untranslatable::LostPlace, at, {}});
  turned_by_.clear();
  return true;
}

bool TranslationRun::lacks(const std::set<UnknownMode>& needed) const {
  return std::any_of(needed.begin(), needed.end(), [&](UnknownMode mode) { return unknown_.contains(mode); });
}

/// What of the `needed` the program must give anew.
BlockRefusal TranslationRun::missing_modes(const std::set<UnknownMode>& needed, std::size_t at) const {
  static constexpr std::pair<UnknownMode, std::string_view> kGs[] = {
      {UnknownMode::Plane, "G17/G18/G19"}, {UnknownMode::Units, "G20/G21"},       {UnknownMode::Distance, "G90/G91"},
      {UnknownMode::FeedMode, "G93/G94"},  {UnknownMode::Centers, "G90.1/G91.1"}, {UnknownMode::Retract, "G98/G99"},
      {UnknownMode::ZeroPoint, "G54"},     {UnknownMode::Shift, "G92"},           {UnknownMode::LocalShift, "G52"}};
  std::string names;
  for (const auto& [mode, name] : kGs)
    if (needed.contains(mode) && unknown_.contains(mode)) names += fmt::format("{}{}", names.empty() ? "" : ", ", name);
  return {Untranslatable::ModeUnknown, at, {names}};
}

/// Whether a tool is mounted that the program means; the first one may come from the map.
bool TranslationRun::has_tool(CurrentBlock& current) {
  mount_first_tool();
  if (tool_is_mounted_ && !tool_is_wrong_) return true;
  const bool is_first = !tool_is_wrong_ && said_once_.insert(Untranslatable::NoTool).second;
  const std::size_t at = current.words.empty() ? 0 : current.words.front().at;
  refuse_motion(current, is_first ? std::optional(BlockRefusal{Untranslatable::NoTool, at, {}}) : std::nullopt);
  return false;
}

/// G53: the block's coordinates are those of the machine.
void TranslationRun::move_in_machine(CurrentBlock& current) {
  if (now_.incremental || motion_ < 0 || motion_ > 1)
    return refuse_motion(current,
                         BlockRefusal{Untranslatable::MachineCoordinates, current.g_of(MachineCoordinates).at, {}});
  if (!has_tool(current)) return;
  std::set needed{UnknownMode::Units, UnknownMode::Distance};
  if (motion_ == 1) needed.insert(UnknownMode::FeedMode);
  if (lacks(needed)) return refuse_motion(current, missing_modes(needed, current.words.front().at));
  const bool is_lost = std::any_of(lost_.begin(), lost_.end(), [](bool lost) { return lost; });
  if (is_lost && motion_ == 1)
    return refuse_motion(current, BlockRefusal{Untranslatable::LostPlace, current.words.front().at, {}});
  std::string words = axis_words(current);
  if (motion_ == 1 && !take_feed(current, words)) return;
  if (motion_ == 0) apply_feed(current);
  KnownPlace machine = frames_.to_machine(place_);
  mount_frame({});
  write_motion(current, motion_, words);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const ForeignWord* const word = current.find(kMotionAxes[axis]);
    if (word == nullptr) continue;
    machine.at[static_cast<Eigen::Index>(axis)] = length_of(*word);
    machine.known[axis] = true;
    find_again(axis);
  }
  place_ = frames_.from_machine(machine);
}

void TranslationRun::move_straight(CurrentBlock& current) {
  if (!may_move(current, motion_ == 1)) return;
  std::string words = axis_words(current);
  if (motion_ == 1 && !take_feed(current, words)) return;
  if (motion_ == 0) apply_feed(current);
  mount_selected_frame();
  write_motion(current, motion_, words);
  arrive(current, target(current));
}

void TranslationRun::move_along_arc(CurrentBlock& current) {
  if (!may_move(current, true)) return;
  const ForeignPlane& plane = foreign_plane(now_.plane);
  const KnownPlace end = target(current);
  const ForeignWord* const r = current.find('R');
  const ForeignWord* const p = current.find('P');
  const double turns = p == nullptr ? 1 : p->value;
  if (!(turns >= 1 && turns <= kMaxTurns && turns == std::floor(turns)))
    return refuse_motion(current, BlockRefusal{Untranslatable::ArcTurns, p->at, {"P" + p->digits}});
  if (turns > 1 && !may_expand(turns))
    return refuse_motion(current, BlockRefusal{Untranslatable::CycleTooManyMoves, p->at, {"P" + p->digits}});
  const auto is_known = [&](int axis) { return place_.known[static_cast<std::size_t>(axis)]; };
  const bool is_plain_radius = r != nullptr && r->value > 0 && turns == 1 && !current.has_any("IJK");
  const bool needs_start = turns > 1 || !(is_plain_radius || (now_.incremental && !centers_absolute_));
  if (needs_start && !(is_known(plane.u) && is_known(plane.v))) {
    const char unknown = kMotionAxes[is_known(plane.u) ? plane.v : plane.u];
    return refuse_motion(
        current, BlockRefusal{Untranslatable::ArcStartUnknown, current.words.front().at, {std::string(1, unknown)}});
  }
  const bool is_measurable = now_.incremental || (is_known(plane.u) && is_known(plane.v));
  Vec3 center = Vec3::Zero();
  if (is_measurable) {
    const std::optional<Vec3> found = arc_center(current, place_.at, end.at);
    if (!found) return;
    center = *found;
  }
  std::string words = axis_words(current);
  const bool names_end = current.find(kMotionAxes[plane.u]) != nullptr || current.find(kMotionAxes[plane.v]) != nullptr;
  if (is_plain_radius) {
    words += " R" + r->digits;
    if (!names_end) return refuse_motion(current, BlockRefusal{Untranslatable::CenterMissing, r->at, {}});
    if (!take_feed(current, words)) return;
    mount_selected_frame();
    write_motion(current, motion_, words);
  } else {
    if (!names_end) words += " " + coordinate(plane.u, end.at[plane.u]);
    words += center_words(plane, center);
    std::string feed;
    if (!take_feed(current, feed)) return;
    mount_selected_frame();
    if (turns > 1) {
      write_turns(current, center, end.at, static_cast<int>(turns), feed);
      words = coordinate(plane.u, end.at[plane.u]) + " " + coordinate(plane.v, end.at[plane.v]) + " " +
              coordinate(plane.normal, end.at[plane.normal]) + center_words(plane, center);
    }
    write_motion(current, motion_, words + feed);
  }
  arrive(current, end);
}

/// ` I10 J0`: absolute in G90, from the arc's start in G91.
std::string TranslationRun::center_words(const ForeignPlane& plane, const Vec3& center) const {
  std::string words;
  for (const int axis : {std::min(plane.u, plane.v), std::max(plane.u, plane.v)}) {
    const double value = now_.incremental ? center[axis] - place_.at[axis] : center[axis];
    words += fmt::format(" {}{}", kCenterLetters[axis], written_number(value / unit()));
  }
  return words;
}

/// The center that the block means, once it fits both ends; otherwise the block is left as a comment.
std::optional<Vec3> TranslationRun::arc_center(CurrentBlock& current, const Vec3& start, const Vec3& end) {
  const ForeignPlane& plane = foreign_plane(now_.plane);
  const ForeignWord* const i = current.find(kCenterLetters[plane.u]);
  const ForeignWord* const j = current.find(kCenterLetters[plane.v]);
  const ForeignWord* const stray = current.find(kCenterLetters[plane.normal]);
  const ForeignWord* const r = current.find('R');
  const auto refused = [&](BlockRefusal refusal) -> std::optional<Vec3> {
    refuse_motion(current, std::move(refusal));
    return std::nullopt;
  };
  const std::size_t at = current.words.front().at;
  const bool has_center = i != nullptr || j != nullptr;
  if (stray != nullptr && stray->value != 0)
    return refused({Untranslatable::UnknownWord, stray->at, {stray->letter + stray->digits}});
  if (has_center && r != nullptr) return refused({Untranslatable::UnknownWord, r->at, {"R" + r->digits}});
  const bool is_incomplete = centers_absolute_ && (i == nullptr || j == nullptr);
  if (r == nullptr && (!has_center || is_incomplete)) return refused({Untranslatable::CenterMissing, at, {}});
  const geometry::PlanePoint chord{end[plane.u] - start[plane.u], end[plane.v] - start[plane.v]};
  geometry::PlanePoint offset;
  if (r == nullptr) {
    const auto value = [&](const ForeignWord* word, int axis) {
      const double length = word == nullptr ? 0 : length_of(*word);
      return centers_absolute_ ? length - start[axis] : length;
    };
    offset = {value(i, plane.u), value(j, plane.v)};
    const geometry::Circle circle = geometry::find_circle(
        {.end = chord, .center_u = offset.u, .center_v = offset.v, .counterclockwise = motion_ == 3},
        setup_.arc_tolerance);
    if (circle.problem != geometry::ArcProblem::None)
      return refused(
          {Untranslatable::ArcMismatch, at, {written_number(circle.found, 4), written_number(circle.wanted, 4)}});
  } else {
    const double radius = std::abs(length_of(*r));
    const bool is_left = (motion_ == 3) == (r->value > 0);  // Of the chord, seen along it.
    const geometry::Circle circle =
        geometry::find_circle({.end = chord, .radius = radius, .counterclockwise = is_left}, setup_.arc_tolerance);
    if (circle.goes_nowhere || radius == 0) return refused({Untranslatable::CenterMissing, r->at, {}});
    if (circle.problem != geometry::ArcProblem::None)
      return refused(
          {Untranslatable::ArcMismatch, r->at, {written_number(circle.found, 4), written_number(circle.wanted, 4)}});
    offset = circle.center;
  }
  Vec3 center = start;
  center[plane.u] += offset.u;
  center[plane.v] += offset.v;
  return center;
}

/// P of LinuxCNC: whole turns before the last one, which the arc itself makes with the `feed` that is left. Under G93
/// the F of the block is that of all turns together, and each motion gets its part of the time.
void TranslationRun::write_turns(CurrentBlock& current, const Vec3& center, const Vec3& end, int turns,
                                 std::string& feed) {
  const ForeignPlane& plane = foreign_plane(now_.plane);
  const Vec3 start = place_.at;
  const double degrees =
      std::abs(geometry::sweep_deg({center[plane.u] - start[plane.u], center[plane.v] - start[plane.v]},
                                   {end[plane.u] - start[plane.u], end[plane.v] - start[plane.v]}, motion_ == 3));
  const double all_degrees = degrees + 360 * (turns - 1);
  const double rise = (end[plane.normal] - start[plane.normal]) * 360 / all_degrees;
  std::string feed_of_last;
  if (now_.inverse_time) {
    const double rate = current.find('F')->value;
    feed = " F" + written_number(rate * all_degrees / 360);
    feed_of_last = " F" + written_number(rate * all_degrees / degrees);
  }
  for (int turn = 1; turn < turns; ++turn) {
    std::string words = coordinate(plane.u, start[plane.u]) + " " + coordinate(plane.v, start[plane.v]);
    const double level = start[plane.normal] + rise * turn;
    words += " " + coordinate(plane.normal, level) + center_words(plane, center) + feed;
    write_motion(current, motion_, words);
    place_.at[plane.normal] = level;
    if (!now_.inverse_time) feed.clear();
  }
  feed = feed_of_last;
}

/// Stores the F of a block, for the next feed move that needs it.
void TranslationRun::apply_feed(CurrentBlock& current) {
  const ForeignWord* const f = current.find('F');
  if (f == nullptr || now_.inverse_time || suspended_by_.contains(PerTurn)) return;
  if (f->is_formula || lacks({UnknownMode::Units, UnknownMode::FeedMode})) return feed_.reset();
  if (!(f->value > 0)) return leave_out(current, Untranslatable::FeedNotPositive, *f);
  feed_ = length_of(*f);
  feed_digits_ = f->digits;
  feed_in_inches_ = now_.inches;
  feed_is_written_ = false;
}

/// Adds the F that a feed move needs; without any, the block is left as a comment.
bool TranslationRun::take_feed(CurrentBlock& current, std::string& words) {
  const ForeignWord* const f = current.find('F');
  const std::size_t at = current.words.front().at;
  if (now_.inverse_time) {
    if (f != nullptr && f->value > 0) {
      words += " F" + f->digits;
      return true;
    }
  } else {
    apply_feed(current);
    if (feed_) {
      if (!feed_is_written_)
        words += " F" + (feed_in_inches_ == now_.inches ? feed_digits_ : written_number(*feed_ / unit()));
      feed_is_written_ = true;
      return true;
    }
  }
  refuse_motion(current, BlockRefusal{Untranslatable::FeedMissing, at, {}});
  return false;
}

/// A motion as the block has it; its G where that is not in force, or where the block writes it.
void TranslationRun::write_motion(CurrentBlock& current, int g, const std::string& words) {
  const std::string_view arguments = words.starts_with(' ') ? std::string_view(words).substr(1) : words;
  const bool states_g = g != written_motion_ || (current.writes_motion && g == motion_);
  const std::string_view exact = g > 0 && (exact_stop_ || current.exact_stop) ? " G09" : "";
  write_motion_in(current, g, fmt::format("{}{}{}", states_g ? fmt::format("G{:02} ", g) : "", arguments, exact),
                  now_.incremental);
}

/// The line of a motion: functions and settings before it, functions after it.
void TranslationRun::write_motion_in(CurrentBlock& current, int g, const std::string& motion, bool incremental) {
  std::string line;
  const auto add = [&](std::string_view word) {
    if (!line.empty() && !word.empty()) line += ' ';
    line += word;
  };
  if (compensation_ == 40 && written_compensation_ != 40) writer_.add_code("G40");
  for (const std::string& word : current.before) add(word);
  add(settings(incremental));
  if (compensation_ != 40 && compensation_ != written_compensation_) add(fmt::format("G{}", compensation_));
  written_compensation_ = compensation_;
  written_motion_ = g;
  add(motion);
  for (const std::string& word : current.after) add(word);
  current.before.clear();
  current.after.clear();
  current.has_moved = true;
  writer_.add_code(line);
}

KnownPlace TranslationRun::target(const CurrentBlock& current) const {
  KnownPlace place = place_;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const ForeignWord* const word = current.find(kMotionAxes[axis]);
    if (word == nullptr) continue;
    const auto i = static_cast<Eigen::Index>(axis);
    place.at[i] = now_.incremental ? place.at[i] + length_of(*word) : length_of(*word);
    place.known[axis] = place.known[axis] || !now_.incremental;
  }
  return place;
}

void TranslationRun::arrive(const CurrentBlock& current, const KnownPlace& at) {
  place_ = at;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (current.find(kMotionAxes[axis]) != nullptr) find_again(axis);
}

/// The program has given the axis anew.
void TranslationRun::find_again(std::size_t axis) {
  lost_[axis] = false;
  if (left_by_cycle_ == static_cast<int>(axis)) left_by_cycle_ = -1;
}

/// The block would have moved these axes, or may have moved all.
void TranslationRun::lose(const CurrentBlock& current, bool everything) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!everything && current.find(kMotionAxes[axis]) == nullptr) continue;
    find_again(axis);
    lost_[axis] = true;
    place_.known[axis] = false;
  }
}

/// ` X10 Y-5.0`, as the block has them.
std::string TranslationRun::axis_words(const CurrentBlock& current) const {
  std::string words;
  for (const ForeignWord& word : current.words)
    if (word.letter >= 'X' && word.letter <= 'Z') words += fmt::format(" {}{}", word.letter, word.digits);
  return words;
}

/// `X10`: a place along an axis, or in G91 the way to it. Exact enough to state a place again.
std::string TranslationRun::coordinate(int axis, double mm) const {
  static constexpr double kExact = 1e-9;
  const double value = (now_.incremental ? mm - place_.at[axis] : mm) / unit();
  const bool is_short = std::abs(value - std::round(value * 1e6) / 1e6) < kExact;
  return kMotionAxes[axis] + written_number(value, is_short ? 6 : 9);
}

}  // namespace isocnc::translation
