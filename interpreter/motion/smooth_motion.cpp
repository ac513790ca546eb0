#include "interpreter/motion/smooth_motion.h"

#include <algorithm>
#include <cmath>

namespace isocnc::motion {

/// Minimum number of pieces that triggers planning, since one cell may hold many pieces.
static constexpr std::size_t kCellBatch = 256;
/// Maximum number of unplanned cells. If the machine cannot stop within more, it comes to rest at the end of them.
static constexpr std::size_t kMaxUnplanned = 2048;
/// Maximum number of steps of the search for the time of a place: Newton steps, replaced by bisection where they fail.
static constexpr int kMaxSteps = 60;

/// Returns the norm of the maximum speeds of all joints, an upper bound of the speed along any path.
static double max_speed(const kinematics::Machine& machine) {
  double sum = 0;
  for (const kinematics::AxisLimits& axis : machine.axes) sum += axis.speed * axis.speed;
  return std::sqrt(sum);
}

SmoothMotion::SmoothMotion(const kinematics::Machine& machine, const kinematics::Smoothing& smoothing, double start)
    : smoothing_(smoothing),
      max_speed_(max_speed(machine)),
      window_minimum_(smoothing.window, max_speed_),
      peak_trimmer_(smoothing.window),
      average_(smoothing.window),
      batch_(kCellBatch),
      time_(start) {}

void SmoothMotion::append(const kinematics::Machine& machine, const Piece& piece,
                          const kinematics::DerivativeBounds& bounds, double feed_cap) {
  pieces_.push_back({piece, end_});
  end_ += piece.length;
  window_minimum_.append(piece.length, kinematics::smoothed_limits(machine, smoothing_, bounds,
                                                                   std::min(feed_cap, max_speed_ * max_speed_)));
  take_cells();
}

void SmoothMotion::take_cells() {
  while (const Cell* const cell = window_minimum_.next()) {
    profile_.append_line(cell->begin, cell->length, cell->limits);
    if (!profile_.wants_planning() && pieces_.size() < batch_) continue;
    profile_.plan_ahead();
    if (profile_.unplanned() > kMaxUnplanned) {
      pause();
    } else {
      take_phases();
    }
    batch_ = std::max(kCellBatch, 2 * pieces_.size());
  }
}

void SmoothMotion::take_phases() {
  while (const Profile::SpeedSpan* const span = profile_.front()) {
    for (std::size_t i = 0; i < span->phase_count; ++i) peak_trimmer_.append(span->phases[i]);
    profile_.pop();
    take_trimmed_phases();
  }
  if (profile_.holds_much_past()) profile_.forget_handed_out();
}

void SmoothMotion::take_trimmed_phases() {
  while (peak_trimmer_.has_next()) average_.append(peak_trimmer_.next(), smooth_);
  for (const Phase& phase : smooth_) place_on_pieces(phase);
  smooth_.clear();
}

/// Brings the machine to rest at the end of all cells taken so far.
void SmoothMotion::pause() {
  profile_.come_to_rest();
  take_phases();
  peak_trimmer_.come_to_rest();
  take_trimmed_phases();
  average_.come_to_rest(smooth_);
  take_trimmed_phases();
}

void SmoothMotion::come_to_rest() {
  window_minimum_.come_to_rest();
  take_cells();
  pause();
  while (!pieces_.empty()) finish_piece();
  end_ = 0;
}

/// Returns the time, from the start of a phase, at which s reaches `place`, s. The place must be within the phase.
static double time_at(const Phase& phase, double place) {
  double early = 0;
  double late = phase.duration;
  double time = late / 2;
  for (int i = 0; i < kMaxSteps; ++i) {
    const Phase now = phase.after(time);
    const double off = place - now.from;
    if (off == 0) break;
    (off > 0 ? early : late) = time;
    const double step = now.speed > 0 ? time + off / now.speed : early;
    const double next = step > early && step < late ? step : (early + late) / 2;
    if (next == time || std::abs(next - time) < 1e-16 * phase.duration) break;
    time = next;
  }
  return time;
}

/// Adds a phase of the mean to the stretches of the pieces that it runs along, cut where pieces meet.
void SmoothMotion::place_on_pieces(Phase phase) {
  while (pieces_.size() > 1 && phase.after(phase.duration).from > pieces_.front().end()) {
    const double place = pieces_.front().end();
    const double time = phase.from < place ? time_at(phase, place) : 0;
    Phase first = phase;
    first.duration = time;
    add(first);
    finish_piece();
    phase = phase.after(time);
  }
  add(phase);
}

void SmoothMotion::add(Phase phase) {
  if (!(phase.duration > 0)) return;
  if (static_cast<std::size_t>(stretch_.phase_count) == stretch_.phases.size()) emit(false);
  const PlacedPiece& placed = pieces_.front();
  phase.from += placed.piece.begin - placed.begin;
  stretch_.phases[static_cast<std::size_t>(stretch_.phase_count++)] = phase;
  stretch_.duration += phase.duration;
}

void SmoothMotion::finish_piece() {
  const Piece& piece = pieces_.front().piece;
  if (stretch_.phase_count == 0 && piece.ends_move)
    stretch_.phases[static_cast<std::size_t>(stretch_.phase_count++)] = {.from = piece.begin + piece.length};
  if (stretch_.phase_count > 0) emit(piece.ends_move);
  pieces_.pop_front();
}

void SmoothMotion::emit(bool ends_move) {
  const Piece& piece = pieces_.front().piece;
  stretch_.tag = piece.tag;
  stretch_.ends_move = ends_move;
  stretch_.path = piece.path;
  stretch_.start = time_;
  time_ += stretch_.duration;
  stretches_.push_back(stretch_);
  stretch_.phase_count = 0;
  stretch_.duration = 0;
}

const Stretch* SmoothMotion::next() {
  if (handed_out_ < stretches_.size()) return &stretches_[handed_out_++];
  stretches_.clear();
  handed_out_ = 0;
  return nullptr;
}

}  // namespace isocnc::motion
