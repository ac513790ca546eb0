#include "interpreter/execution/plain_run.h"

#include "interpreter/execution/feed.h"
#include "interpreter/execution/plane.h"
#include "interpreter/geometry/arc.h"
#include "interpreter/geometry/increment.h"

namespace isocnc::execution {

using syntax::Word;

/// Whether a fast test shows that an arc is valid; Executor::arc() decides about the others.
bool PlainRun::is_sound_arc(std::span<const Word> words, dialect::LetterSet arguments) {
  const Plane& plane = plane_in_force(state_);
  const auto has = [&](char letter) { return dialect::contains(arguments, letter); };
  if ((arguments & dialect::kRotaryLetters) != 0 || state_.face_mounted || has(plane.stray_center)) return false;
  if (!has(plane.u_letter) && !has(plane.v_letter)) return false;
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
  has_taken_feed_ = true;
}

void PlainRun::finish() {
  state_.set_mode(dialect::g_code(motion_));
  state_.motion_illegible = false;
  state_.exact_stop_fits = motion_ != dialect::GRole::Rapid;
  state_.tool_prepared = false;
}

}  // namespace isocnc::execution
