#include "interpreter/motion/stretch.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace isocnc::motion {

Phase Phase::after(double time) const {
  return {duration - time, from + time * (speed + time * (acceleration / 2 + time * jerk / 6)),
          speed + time * (acceleration + time * jerk / 2), acceleration + time * jerk, jerk};
}

/// Converts derivatives by s to derivatives by time.
static kinematics::Jet in_time(const kinematics::Jet& jet, double speed, double acceleration) {
  return {jet.value, speed * jet.first, speed * speed * jet.second + acceleration * jet.first};
}

static Sample sample(const kinematics::Jet& tip, const kinematics::Jet& joints, double time) {
  Sample result{.time = time,
                .tip = kinematics::pose(tip.value),
                .joints = joints.value,
                .joint_speeds = joints.first,
                .joint_accelerations = joints.second,
                .speed = tip.first.head<3>().norm()};
  if (result.speed > 0) result.acceleration = tip.first.head<3>().dot(tip.second.head<3>()) / result.speed;
  return result;
}

/// Returns the rest of the phase in progress at a time, clamped to the stretch.
static Phase phase_at(const Stretch& stretch, double time) {
  double t = std::clamp(time - stretch.start, 0.0, stretch.duration);
  std::size_t i = 0;
  while (i + 1 < static_cast<std::size_t>(stretch.phase_count) && t > stretch.phases[i].duration)
    t -= stretch.phases[i++].duration;
  return stretch.phases[i].after(std::min(t, stretch.phases[i].duration));
}

Sample Stretch::at(const kinematics::Kinematics& kinematics, double time) const {
  const Phase now = phase_at(*this, time);
  return sample(in_time(path.tip_at(kinematics, now.from), now.speed, now.acceleration),
                in_time(path.joints_at(kinematics, now.from), now.speed, now.acceleration),
                std::clamp(time, start, start + duration));
}

double Stretch::parameter_at(double time) const { return phase_at(*this, time).from; }

/// By Newton's method, whose result may be wrong by some roundings, and halving around it down to neighboring doubles.
double Stretch::time_at(double s) const {
  double early = start;
  double late = start + duration;
  if (!(phases[0].from < s)) return early;
  if (!(s < parameter_at(late))) return late;
  double guess = std::midpoint(early, late);
  for (int i = 0; i < 8; ++i) {
    const Phase now = phase_at(*this, guess);
    if (!(now.speed > 0)) break;
    const double step = (s - now.from) / now.speed;
    guess = std::clamp(guess + step, early, late);
    if (std::abs(step) < 1e-13 * late) break;
  }
  const double end = late;
  for (double width = 1e-15 * end; early < guess - width; width *= 8) {
    if (parameter_at(guess - width) < s) {
      early = guess - width;
      break;
    }
  }
  for (double width = 1e-15 * end; guess + width < end; width *= 8) {
    if (!(parameter_at(guess + width) < s)) {
      late = guess + width;
      break;
    }
  }
  for (double middle = std::midpoint(early, late); early < middle && middle < late;
       middle = std::midpoint(early, late)) {
    (parameter_at(middle) < s ? early : late) = middle;
  }
  return late;
}

}  // namespace isocnc::motion
