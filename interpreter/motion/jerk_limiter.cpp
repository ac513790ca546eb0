#include "interpreter/motion/jerk_limiter.h"

#include <algorithm>
#include <utility>

namespace isocnc::motion {

/// Number of pieces after a rest with which candidates for the smoothing are tried.
static constexpr std::size_t kTrialPieces = 256;
/// Candidates for Smoothing::curves_part, the first as default.
static constexpr double kCurvesParts[] = {0.8, 0.6, 0.4, 0.2};
/// Search for the window: number of halvings of the longest one, then of golden-section steps around the best.
static constexpr int kHalvings = 8;
static constexpr int kSteps = 8;
/// Minimum length of a window, s. Rounding errors would show with shorter windows.
static constexpr double kMinWindow = 1e-4;
/// Golden ratio minus 1.
static constexpr double kGolden = 0.6180339887498949;

void JerkLimiter::append(const kinematics::Machine& machine, const Piece& piece, double feed_cap) {
  const kinematics::DerivativeBounds bounds =
      kinematics::derivative_bounds(machine.kinematics, piece.path, piece.begin, piece.begin + piece.length);
  if (motion_) return motion_->append(machine, piece, bounds, feed_cap);
  first_pieces_.push_back({piece, bounds, feed_cap});
  if (first_pieces_.size() >= kTrialPieces) begin(machine);
}

void JerkLimiter::append_phase(const Piece& piece, const Phase& phase) {
  Stretch& stretch = finished_.emplace_back();
  stretch.tag = piece.tag;
  stretch.ends_move = piece.ends_move;
  stretch.start = std::exchange(time_, time_ + phase.duration);
  stretch.duration = phase.duration;
  stretch.path = piece.path;
  stretch.phases[0] = phase;
  stretch.phase_count = 1;
}

void JerkLimiter::begin(const kinematics::Machine& machine) {
  motion_.emplace(machine, best_smoothing(machine), time_);
  for (const PendingPiece& pending : first_pieces_)
    motion_->append(machine, pending.piece, pending.bounds, pending.feed_cap);
  first_pieces_.clear();
}

void JerkLimiter::come_to_rest(const kinematics::Machine& machine) {
  if (!first_pieces_.empty()) begin(machine);
  if (!motion_) return;
  motion_->come_to_rest();
  while (const Stretch* const stretch = motion_->next()) finished_.push_back(*stretch);
  time_ = motion_->time();
  motion_.reset();
}

/// Returns the time that the first pieces take with this smoothing, from rest to rest, s.
double JerkLimiter::time_with(const kinematics::Machine& machine, const kinematics::Smoothing& smoothing) const {
  SmoothMotion trial(machine, smoothing, 0);
  for (const PendingPiece& pending : first_pieces_)
    trial.append(machine, pending.piece, pending.bounds, pending.feed_cap);
  trial.come_to_rest();
  return trial.time();
}

/// Returns the smoothing with which the first pieces take the shortest time. A long window lets the axes use their full
/// accelerations, a short one loses less time at each change of speed. The part of the jerk for curves is a compromise
/// of the same kind.
kinematics::Smoothing JerkLimiter::best_smoothing(const kinematics::Machine& machine) const {
  const double longest = kinematics::smoothing_window(machine);
  kinematics::Smoothing best{longest, kCurvesParts[0]};
  double shortest = time_with(machine, best);
  const auto consider = [&](const kinematics::Smoothing& smoothing) {
    const double time = time_with(machine, smoothing);
    if (time < shortest) best = smoothing;
    shortest = std::min(time, shortest);
    return time;
  };
  const bool has_curves = std::any_of(first_pieces_.begin(), first_pieces_.end(),
                                      [](const PendingPiece& pending) { return !pending.bounds.third.isZero(0); });
  for (const double part : kCurvesParts) {
    double before = consider({longest, part});
    double window = longest;
    for (int i = 0; i < kHalvings && window > kMinWindow; ++i) {
      const double time = consider({window /= 2, part});
      if (time >= std::exchange(before, time)) break;
    }
    if (!has_curves) break;
  }
  const double part = best.curves_part;
  double low_end = best.window / 2;
  double high_end = best.window * 2;
  double low = high_end - kGolden * (high_end - low_end);
  double high = low_end + kGolden * (high_end - low_end);
  double low_time = consider({low, part});
  double high_time = consider({high, part});
  for (int i = 0; i < kSteps; ++i) {
    if (low_time < high_time) {
      high_end = std::exchange(high, low);
      high_time = std::exchange(low_time, consider({low = high_end - kGolden * (high_end - low_end), part}));
    } else {
      low_end = std::exchange(low, high);
      low_time = std::exchange(high_time, consider({high = low_end + kGolden * (high_end - low_end), part}));
    }
  }
  return best;
}

const Stretch* JerkLimiter::next() {
  if (handed_out_ < finished_.size()) return &finished_[handed_out_++];
  finished_.clear();
  handed_out_ = 0;
  return motion_ ? motion_->next() : nullptr;
}

}  // namespace isocnc::motion
