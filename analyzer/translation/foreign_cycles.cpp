#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "analyzer/translation/translation_run.h"

namespace isocnc::translation {

using Untranslatable = UntranslatableReason;
using enum ForeignRole;

static constexpr char kCycleAxes[] = {'X', 'Y', 'Z'};
static constexpr double kMaxHoles = 10'000;
static constexpr double kMaxPecks = 10'000;
static constexpr double kMaxExpandedMoves = 2'000'000;  // Of a program.
static constexpr double kLevelsDiffer = 1e-9;           // mm

/// A drilling cycle as moves: to the hole, to R, down as the cycle goes, and up to R or to where the tool was.
void TranslationRun::drill(CurrentBlock& current) {
  if (!may_move(current, true)) return;
  const ForeignPlane& plane = foreign_plane(now_.plane);
  const std::string name = fmt::format("G{}", motion_);
  const std::size_t at = current.words.front().at;
  const auto axis = static_cast<std::size_t>(plane.normal);
  if (!place_.known[axis] && left_by_cycle_ != plane.normal)
    return refuse_motion(current,
                         BlockRefusal{Untranslatable::PlaceUnknown, at, {name, std::string(1, kCycleAxes[axis])}});
  if (!read_cycle(current)) return;
  apply_feed(current);
  if (now_.inverse_time || !feed_) return refuse_motion(current, BlockRefusal{Untranslatable::FeedMissing, at, {}});
  const ForeignWord* repeats = current.find('L');
  if (repeats == nullptr && setup_.control == SourceControl::Fanuc) repeats = current.find('K');
  const double holes = repeats == nullptr ? 1 : repeats->value;
  if (!(holes >= 0 && holes <= kMaxHoles))
    return refuse_motion(
        current, BlockRefusal{Untranslatable::CycleTooManyMoves, repeats->at, {repeats->letter + repeats->digits}});
  const double pecks = cycle_.peck ? (*cycle_.r - *cycle_.bottom) / *cycle_.peck : 1;
  if (!may_expand(holes * (3 * pecks + 3)))
    return refuse_motion(current, BlockRefusal{Untranslatable::CycleTooManyMoves, at, {name}});
  mount_selected_frame();
  flush_words(current);
  write_settings();
  const double r = *cycle_.r;
  if (holes >= 1 && place_.at[plane.normal] < r - kLevelsDiffer) rapid_to(plane.normal, r);
  for (int hole = 0; hole < static_cast<int>(holes); ++hole) drill_hole(current);
  if (holes >= 1) settle_height();
}

/// After a cycle the tool is at a known height, unless neither G98 nor G99 is stated: rs274 then goes back to R, other
/// machines may be set otherwise. The tool is left at the higher place, which is clear of the part in any case.
void TranslationRun::settle_height() {
  const int normal = foreign_plane(now_.plane).normal;
  const auto axis = static_cast<std::size_t>(normal);
  const bool may_be_lower = !retract_is_stated_ || (!retracts_to_r_ && left_by_cycle_ == normal);
  const bool is_known = !may_be_lower || place_.at[normal] < *cycle_.r + kLevelsDiffer;
  if (is_known) find_again(axis);
  place_.known[axis] = is_known;
  if (is_known) return;
  lost_[axis] = true;
  left_by_cycle_ = normal;
}

/// Whether so many moves may be written for one block: a few words must not fill the disk.
bool TranslationRun::may_expand(double moves) {
  if (expanded_moves_ + moves > kMaxExpandedMoves) return false;
  expanded_moves_ += moves;
  return true;
}

/// The numbers of the cycle: those of this block, and those that hold from above.
bool TranslationRun::read_cycle(CurrentBlock& current) {
  const ForeignPlane& plane = foreign_plane(now_.plane);
  const double level = place_.at[plane.normal];
  const bool is_fanuc = setup_.control == SourceControl::Fanuc;
  if (cycle_.g == 0) cycle_.initial = level;
  if (cycle_.g != motion_ && !is_fanuc) cycle_ = {.initial = cycle_.initial};
  cycle_.g = motion_;
  const auto refused = [&](Untranslatable reason, std::size_t at, std::vector<std::string> values) {
    refuse_motion(current, BlockRefusal{reason, at, std::move(values)});
    return false;
  };
  const std::size_t at = current.words.front().at;
  if (const ForeignWord* const r = current.find('R')) {
    cycle_.r = length_of(*r) + (now_.incremental ? (is_fanuc ? cycle_.initial : level) : 0);
    cycle_.r_is_increment = now_.incremental;
  }
  // LinuxCNC takes what holds from above as increments under G91, whatever it was given under.
  const auto holds = [&](bool is_increment) { return is_fanuc || is_increment == now_.incremental; };
  if (!cycle_.r || !holds(cycle_.r_is_increment)) return refused(Untranslatable::CycleIncomplete, at, {"R"});
  if (const ForeignWord* const z = current.find(kCycleAxes[plane.normal])) {
    cycle_.bottom = length_of(*z) + (now_.incremental ? *cycle_.r : 0);
    cycle_.bottom_is_increment = now_.incremental;
  }
  if (!cycle_.bottom || !holds(cycle_.bottom_is_increment))
    return refused(Untranslatable::CycleIncomplete, at, {std::string(1, kCycleAxes[plane.normal])});
  if (const ForeignWord* const q = current.find('Q')) cycle_.peck = std::abs(length_of(*q));
  if (const ForeignWord* const p = current.find('P')) cycle_.dwell = is_fanuc ? p->value / 1000 : p->value;
  if (*cycle_.bottom > *cycle_.r) return refused(Untranslatable::CycleDepth, at, {});
  const bool pecks = motion_ == 83 || motion_ == 73;
  if (!pecks) cycle_.peck.reset();
  if (pecks && !(cycle_.peck && *cycle_.peck > 0)) return refused(Untranslatable::CycleIncomplete, at, {"Q"});
  if (pecks && (*cycle_.r - *cycle_.bottom) / *cycle_.peck > kMaxPecks) {
    const ForeignWord* const q = current.find('Q');
    return refused(Untranslatable::CycleTooManyMoves, q != nullptr ? q->at : at,
                   {"Q" + written_number(*cycle_.peck / unit())});
  }
  return true;
}

void TranslationRun::drill_hole(CurrentBlock& current) {
  const ForeignPlane& plane = foreign_plane(now_.plane);
  std::string words;
  for (const ForeignWord& word : current.words)
    if (word.letter == kCycleAxes[plane.u] || word.letter == kCycleAxes[plane.v])
      words += fmt::format(" {}{}", word.letter, word.digits);
  if (!words.empty()) {
    const KnownPlace hole = target(current);
    write_cycle_move(0, words.substr(1));
    for (const int axis : {plane.u, plane.v}) {
      const auto i = static_cast<std::size_t>(axis);
      place_.at[axis] = hole.at[axis];
      place_.known[i] = hole.known[i];
    }
  }
  const double r = *cycle_.r;
  if (place_.at[plane.normal] > r + kLevelsDiffer) rapid_to(plane.normal, r);
  if (motion_ == 83 || motion_ == 73)
    write_pecks();
  else
    feed_to(*cycle_.bottom);
  const bool is_fanuc = setup_.control == SourceControl::Fanuc;
  const bool dwells = motion_ == 82 || motion_ == 89 || (motion_ == 86 && !is_fanuc);
  if (dwells && cycle_.dwell && *cycle_.dwell > 0) dwell_for(*cycle_.dwell);
  if (motion_ == 86 && spindle_ != 5) writer_.add_code("M05");
  const double clear = retracts_to_r_ ? r : std::max(r, cycle_.initial);
  if (motion_ == 85 || motion_ == 89) feed_to(motion_ == 89 && !is_fanuc ? clear : r);  // As rs274 does.
  if (std::abs(clear - place_.at[plane.normal]) > kLevelsDiffer) rapid_to(plane.normal, clear);
  if (motion_ == 86 && spindle_ != 5) writer_.add_code(fmt::format("M{:02}", spindle_));
}

/// G83 leaves the hole after each peck, G73 withdraws a little.
void TranslationRun::write_pecks() {
  const int axis = foreign_plane(now_.plane).normal;
  const double standard = setup_.control == SourceControl::Fanuc ? 1 : 0.254;  // rs274 takes a hundredth of an inch.
  const double clearance = setup_.map.peck_clearance.value_or(standard);
  const double r = *cycle_.r;
  for (int peck = 1;; ++peck) {
    const double depth = r - *cycle_.peck * peck;
    if (depth <= *cycle_.bottom + kLevelsDiffer) break;
    feed_to(depth);
    if (motion_ == 83) rapid_to(axis, r);
    const double next = std::min(r, depth + clearance);
    if (std::abs(next - place_.at[axis]) > kLevelsDiffer) rapid_to(axis, next);
  }
  feed_to(*cycle_.bottom);
}

void TranslationRun::write_cycle_move(int g, const std::string& words) {
  std::string line = settings(now_.incremental);
  if (!line.empty()) line += ' ';
  if (g != written_motion_) line += fmt::format("G{:02} ", g);
  written_motion_ = g;
  writer_.add_code(line + words);
}

void TranslationRun::rapid_to(int axis, double mm) {
  write_cycle_move(0, coordinate(axis, mm));
  place_.at[axis] = mm;
}

void TranslationRun::feed_to(double mm) {
  const int axis = foreign_plane(now_.plane).normal;
  std::string words = coordinate(axis, mm);
  if (!feed_is_written_)
    words += " F" + (feed_in_inches_ == now_.inches ? feed_digits_ : written_number(*feed_ / unit()));
  feed_is_written_ = true;
  write_cycle_move(1, words);
  place_.at[axis] = mm;
}

void TranslationRun::dwell_for(double seconds) { writer_.add_code("G04 P" + written_number(seconds)); }

}  // namespace isocnc::translation
