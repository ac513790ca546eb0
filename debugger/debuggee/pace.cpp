#include "debugger/debuggee/pace.h"

#include <limits>

namespace isocnc::debuggee {

void Pace::restart(double machine_time) {
  start_ = Clock::now();
  machine_start_ = machine_time;
}

double Pace::due_time(double speed) const {
  if (!(speed > 0)) return std::numeric_limits<double>::infinity();
  const std::chrono::duration<double> passed = Clock::now() - start_;
  return machine_start_ + passed.count() * speed;
}

}  // namespace isocnc::debuggee
