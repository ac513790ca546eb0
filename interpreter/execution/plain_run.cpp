#include "interpreter/execution/plain_run.h"

#include "interpreter/execution/feed.h"
#include "interpreter/execution/plane.h"
#include "interpreter/geometry/arc.h"
#include "interpreter/geometry/increment.h"

namespace isocnc::execution {

using syntax::Word;

/// Whether a straight motion runs although the position of some axes is unknown; it makes known the axes that it names.
bool PlainRun::runs_from_unknown(dialect::LetterSet arguments) {
  if (unknown_ == 0 || (arguments & ~straight_letters()) != 0) return false;
  unknown_ &= static_cast<AxisSet>(~axes_of(arguments));
  if (unknown_ == 0) straight_ = straight_letters();
  return true;
}

/// Whether a fast test shows that an arc is valid; Executor::arc() decides about the others.
bool PlainRun::is_sound_arc(std::span<const Word> words, dialect::LetterSet arguments) {
  if (unknown_ != 0 || state_.is_in_doubt(dialect::ModalGroup::Plane)) return false;
  const Plane& plane = plane_in_force(state_);
  const auto has = [&](char letter) { return dialect::contains(arguments, letter); };
  if ((arguments & dialect::kRotaryLetters) != 0 || state_.face_mounted || has(plane.stray_center)) return false;
  if (!has(plane.u_letter) && !has(plane.v_letter)) return false;
  effects_.has_arc = true;
  geometry::ArcGiven arc;
  for (const Word& word : words) {
    const double value = word.value * scale_;
    const auto from_start = [&](int axis) { return incremental_ ? value : value - state_.position.tip[axis]; };
    if (word.letter == plane.u_letter) {
      arc.end.u = from_start(plane.u);
    } else if (word.letter == plane.v_letter) {
      arc.end.v = from_start(plane.v);
    } else if (word.letter == plane.u_center) {
      arc.center_u = from_start(plane.u);
    } else if (word.letter == plane.v_center) {
      arc.center_v = from_start(plane.v);
    } else if (word.letter == 'R') {
      arc.radius = value;
    }
  }
  if (!geometry::surely_fits(arc, setup_.arc_tolerance)) return false;
  if (incremental_ || arc.radius) return true;
  const geometry::PlanePoint start{state_.position.tip[plane.u], state_.position.tip[plane.v]};
  if (geometry::surely_absolute(arc, start, setup_.arc_tolerance)) return true;
  met_open_center_ = true;
  return !leaves_open_centers_;
}

/// The words of a line under G91.
void PlainRun::advance_axes(std::span<const Word> words) {
  const auto move = [](double& position, double change) { position = geometry::advanced(position, change); };
  for (const Word& word : words) {
    const auto axis = static_cast<std::uint32_t>(word.letter - 'X');
    if (axis <= 2) {
      move(state_.position.tip[static_cast<Eigen::Index>(axis)], word.value * scale_);
    } else if (word.letter == 'B') {
      move(state_.position.b, word.value);
    } else if (word.letter == 'C') {
      move(state_.position.c, word.value);
    }
  }
}

void PlainRun::take_feed(double number) {
  execution::take_feed(number, state_);
  feed_holds_ = !state_.inverse_time();
  effects_.has_taken_feed = true;
}

void PlainRun::finish() {
  state_.set_mode(dialect::g_code(motion_));
  state_.motion_illegible = false;
  state_.exact_stop_fits = motion_ != dialect::GRole::Rapid;
  state_.tool_prepared = false;
  state_.unknown = unknown_;
}

void PlainRun::copy_passed_on(const State& from, const PlainEffects& row, State& to) {
  const bool turns = (row.letters & dialect::kRotaryLetters) != 0;
  const auto read = static_cast<std::uint16_t>(kJudged | (row.has_arc ? State::bit(dialect::ModalGroup::Plane) : 0) |
                                               (turns ? State::bit(dialect::ModalGroup::Interpolation) : 0));
  for (std::size_t group = 0; group < dialect::kModalGroupCount; ++group)
    if ((read >> group & 1) == 0) to.in_force[group] = from.in_force[group];
  to.written = from.written;
  to.in_doubt = static_cast<std::uint16_t>((to.in_doubt & read) | (from.in_doubt & ~read));
  if (!row.has_arc && !to.incremental()) {
    const AxisSet set = axes_of(row.letters);
    to.unknown = static_cast<AxisSet>((to.unknown & set) | (from.unknown & ~set));
  }

  to.workpiece_origin = from.workpiece_origin;
  to.face = from.face;
  if (!row.has_arc) to.face_mounted = from.face_mounted;
  to.workpiece_unknown = from.workpiece_unknown;
  to.face_undefined = from.face_undefined;
  to.face_unplaced = from.face_unplaced;
  to.dismount_tolerated = from.dismount_tolerated;

  if (!row.has_taken_feed || to.inverse_time()) to.feed_per_minute = from.feed_per_minute;
  if (!row.has_taken_feed) {
    to.last_feed = from.last_feed;
    to.feed_on_rapid = from.feed_on_rapid;
  }
  to.feed_reported = from.feed_reported;

  to.spindle_speed = from.spindle_speed;
  to.speed_known = from.speed_known;
  to.speed_given = from.speed_given;
  to.spindle_function = from.spindle_function;
  to.spindle = from.spindle;
  to.tool = from.tool;
  to.tool_known = from.tool_known;
  to.tool_reported = from.tool_reported;
}

void PlainRun::copy_unread(const State& from, const PlainEffects& row, State& to) {
  copy_passed_on(from, row, to);
  if (row.has_run()) {
    to.motion_illegible = from.motion_illegible;
    to.exact_stop_fits = from.exact_stop_fits;
    to.tool_prepared = from.tool_prepared;
  }
  to.feed_per_minute = from.feed_per_minute;
  to.last_feed = from.last_feed;
  to.feed_on_rapid = from.feed_on_rapid;
  if (!row.has_arc && !to.incremental()) to.unknown = from.unknown;
}

}  // namespace isocnc::execution
