#include "interpreter/motion/softener.h"

#include <algorithm>
#include <utility>

namespace isocnc::motion {

/// By so many pieces after a rest the smoothing is chosen.
static constexpr std::size_t kOpening = 256;
static constexpr double kCurvesParts[] = {0.8, 0.6, 0.4, 0.2};
/// How the window is sought: halvings of the longest one, and then steps between those around the best.
static constexpr int kHalvings = 8;
static constexpr int kSteps = 8;
/// In shorter ones rounding shows, s.
static constexpr double kLeastWindow = 1e-4;
static constexpr double kGolden = 0.6180339887498949;

void Softener::append(const Machine& machine, const Piece& piece, double feed_cap) {
  const Slopes steepest = slopes(machine.kinematics, piece.path, piece.begin, piece.begin + piece.length);
  if (motion_) return motion_->append(machine, piece, steepest, feed_cap);
  opening_.push_back({piece, steepest, feed_cap});
  if (opening_.size() >= kOpening) begin(machine);
}

void Softener::begin(const Machine& machine) {
  motion_.emplace(machine, best_smoothing(machine), time_);
  for (const Waiting& waiting : opening_) motion_->append(machine, waiting.piece, waiting.slopes, waiting.feed_cap);
  opening_.clear();
}

void Softener::come_to_rest(const Machine& machine) {
  if (!opening_.empty()) begin(machine);
  if (!motion_) return;
  motion_->come_to_rest();
  while (const Stretch* const stretch = motion_->next()) finished_.push_back(*stretch);
  time_ = motion_->time();
  motion_.reset();
}

double Softener::time_with(const Machine& machine, const Smoothing& smoothing) const {
  SmoothMotion trial(machine, smoothing, 0);
  for (const Waiting& waiting : opening_) trial.append(machine, waiting.piece, waiting.slopes, waiting.feed_cap);
  trial.come_to_rest();
  return trial.time();
}

/// A long window lets the axes use their accelerations, a short one loses little time at each change of the speed. So
/// it is with what the speed in curves may take of the jerk.
Smoothing Softener::best_smoothing(const Machine& machine) const {
  const double longest = smoothing_window(machine);
  Smoothing best{longest, kCurvesParts[0]};
  double shortest = time_with(machine, best);
  const auto consider = [&](const Smoothing& smoothing) {
    const double time = time_with(machine, smoothing);
    if (time < shortest) best = smoothing;
    shortest = std::min(time, shortest);
    return time;
  };
  const bool has_curves = std::any_of(opening_.begin(), opening_.end(),
                                      [](const Waiting& waiting) { return !waiting.slopes.third.isZero(0); });
  for (const double part : kCurvesParts) {
    double before = consider({longest, part});
    double window = longest;
    for (int i = 0; i < kHalvings && window > kLeastWindow; ++i) {
      const double time = consider({window /= 2, part});
      if (time >= std::exchange(before, time)) break;
    }
    if (!has_curves) break;
  }
  const double part = best.curves_part;
  double least = best.window / 2;
  double most = best.window * 2;
  double low = most - kGolden * (most - least);
  double high = least + kGolden * (most - least);
  double low_time = consider({low, part});
  double high_time = consider({high, part});
  for (int i = 0; i < kSteps; ++i) {
    if (low_time < high_time) {
      most = std::exchange(high, low);
      high_time = std::exchange(low_time, consider({low = most - kGolden * (most - least), part}));
    } else {
      least = std::exchange(low, high);
      low_time = std::exchange(high_time, consider({high = least + kGolden * (most - least), part}));
    }
  }
  return best;
}

const Stretch* Softener::next() {
  if (handed_out_ < finished_.size()) return &finished_[handed_out_++];
  finished_.clear();
  handed_out_ = 0;
  return motion_ ? motion_->next() : nullptr;
}

}  // namespace isocnc::motion
