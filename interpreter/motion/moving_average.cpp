#include "interpreter/motion/moving_average.h"

#include <algorithm>

namespace isocnc::motion {

/// Maximum duration that is a rounding error, s.
static constexpr double kNoTime = 1e-13;

/// Starts a motion, with the whole window before its start.
void MovingAverage::begin(double from) {
  lag_ = {Phase{.duration = window_, .from = from}};
  lag_time_ = 0;
  s_ = from;
}

void MovingAverage::append(const Phase& phase, std::vector<Phase>& out) {
  if (lag_.empty()) begin(phase.from);
  lag_.push_back(phase);
  for (double elapsed = 0; phase.duration - elapsed > kNoTime;) {
    while (lag_.front().duration - lag_time_ <= kNoTime) {
      lag_time_ -= lag_.front().duration;
      lag_.pop_front();
    }
    const double duration = std::min(phase.duration - elapsed, lag_.front().duration - lag_time_);
    step(phase.after(elapsed), duration, out);
    elapsed += duration;
    lag_time_ += duration;
  }
}

/// Advances the window by `duration`. `lead`: motion at the window's leading edge.
void MovingAverage::step(const Phase& lead, double duration, std::vector<Phase>& out) {
  const Phase lag = lag_.front().after(lag_time_);
  const Phase mean{duration, s_, std::max((lead.from - lag.from) / window_, 0.0), (lead.speed - lag.speed) / window_,
                   (lead.acceleration - lag.acceleration) / window_};
  s_ = std::max(mean.after(duration).from, s_);
  out.push_back(mean);
}

void MovingAverage::come_to_rest(std::vector<Phase>& out) {
  if (lag_.empty()) return;
  const Phase last = lag_.back().after(lag_.back().duration);
  append({.duration = window_, .from = last.from}, out);
  lag_.clear();
}

}  // namespace isocnc::motion
