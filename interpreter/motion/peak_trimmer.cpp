#include "interpreter/motion/peak_trimmer.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace isocnc::motion {

static double end_speed(const Phase& phase) { return std::max(phase.after(phase.duration).speed, 0.0); }

static double length(const Phase& phase) { return phase.after(phase.duration).from - phase.from; }

void PeakTrimmer::append(const Phase& phase) {
  if (phase.acceleration > 0) {
    if (has_peak_) trim_peak();
    is_rising_ = true;
  } else if (phase.acceleration < 0 && std::exchange(is_rising_, false)) {
    has_peak_ = true;
    peak_ = phases_.size();
    fallen_time_ = 0;
  }
  phases_.push_back(phase);
  unsettled_time_ += phase.duration;
  fallen_time_ += phase.duration;
  if (has_peak_ && fallen_time_ >= min_duration_) trim_peak();
  if (!has_peak_) settle();
}

void PeakTrimmer::come_to_rest() {
  if (has_peak_) trim_peak();
  settled_ = phases_.size();
  unsettled_time_ = 0;
  is_rising_ = false;
}

Phase PeakTrimmer::next() {
  const Phase phase = phases_.front();
  phases_.pop_front();
  --settled_;
  if (has_peak_) --peak_;
  return phase;
}

/// Settles the phases that no later plateau can reach. A plateau replaces less than its own duration on either side.
void PeakTrimmer::settle() {
  while (settled_ < phases_.size() && unsettled_time_ - phases_[settled_].duration >= min_duration_)
    unsettled_time_ -= phases_[settled_++].duration;
}

/// Lowers the peak until it is a plateau of the minimum duration, or until it meets a valley.
void PeakTrimmer::trim_peak() {
  has_peak_ = false;
  std::size_t up = peak_;  // Index after the phases that accelerate to the peak.
  std::size_t down = peak_;
  double speed = phases_[peak_].speed;
  double distance = 0;
  while (true) {
    while (up > settled_ && phases_[up - 1].acceleration == 0) distance += length(phases_[--up]);
    while (down < phases_.size() && phases_[down].acceleration == 0) distance += length(phases_[down++]);
    const bool is_valley =
        up == settled_ || down == phases_.size() || phases_[up - 1].acceleration < 0 || phases_[down].acceleration > 0;
    if (is_valley || distance >= speed * min_duration_) break;
    const Phase& rise = phases_[up - 1];
    const Phase& fall = phases_[down];
    const double rise_begin = rise.speed;
    const double fall_end = end_speed(fall);
    const double lower = std::max(rise_begin, fall_end);
    const double slopes = 1 / (2 * rise.acceleration) - 1 / (2 * fall.acceleration);
    // A plateau of speed w has the length `distance` + slopes (speed^2 - w^2), and that must equal w times its
    // duration.
    const double reachable = distance + slopes * speed * speed;
    const double level =
        2 * reachable / (min_duration_ + std::sqrt(min_duration_ * min_duration_ + 4 * slopes * reachable));
    if (level >= lower) {
      speed = level;
      break;
    }
    distance += slopes * (speed - lower) * (speed + lower);
    speed = lower;
    if (rise_begin >= lower) --up;
    if (fall_end >= lower) ++down;
  }
  replace(up, down, speed);
}

/// Replaces the phases [first, last), and the parts of their neighbors that are faster than `speed`, by a plateau.
void PeakTrimmer::replace(std::size_t first, std::size_t last, double speed) {
  Phase plateau{.speed = speed};
  if (first > settled_ && phases_[first - 1].acceleration > 0) {
    Phase& rise = phases_[first - 1];
    rise.duration = std::clamp((speed - rise.speed) / rise.acceleration, 0.0, rise.duration);
    plateau.from = rise.after(rise.duration).from;
  } else if (first < phases_.size()) {
    plateau.from = phases_[first].from;
  }
  double end = plateau.from;
  if (last < phases_.size()) {
    Phase& fall = phases_[last];
    if (fall.acceleration < 0)
      fall = fall.after(std::clamp((speed - fall.speed) / fall.acceleration, 0.0, fall.duration));
    end = fall.from;
  } else if (last > first) {
    end = phases_[last - 1].after(phases_[last - 1].duration).from;
  }
  if (speed > 0) plateau.duration = std::max(end - plateau.from, 0.0) / speed;
  const auto begin = phases_.begin() + static_cast<std::ptrdiff_t>(first);
  phases_.erase(begin, phases_.begin() + static_cast<std::ptrdiff_t>(last));
  if (plateau.duration > 0) phases_.insert(phases_.begin() + static_cast<std::ptrdiff_t>(first), plateau);
  unsettled_time_ = 0;
  for (std::size_t i = settled_; i < phases_.size(); ++i) unsettled_time_ += phases_[i].duration;
}

}  // namespace isocnc::motion
