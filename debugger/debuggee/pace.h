#pragma once

#include <chrono>

namespace isocnc::debuggee {

/// Where the machine should be by now, in a run that keeps pace with the clock.
class Pace {
 public:
  /// The machine is at this moment of the program now; seconds.
  void restart(double machine_time);
  /// The moment that the machine should have come to by now, in seconds, or infinity where it runs as fast as possible.
  /// `speed`: 0 as fast as possible, 1 in real time.
  double due_time(double speed) const;

 private:
  using Clock = std::chrono::steady_clock;

  Clock::time_point start_;  ///< Moment of the clock at which the machine was at machine_start_.
  double machine_start_ = 0;
};

}  // namespace isocnc::debuggee
