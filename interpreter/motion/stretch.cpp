#include "interpreter/motion/stretch.h"

#include <algorithm>
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

double Stretch::time_at(double s) const {
  double early = start;
  double late = start + duration;
  for (double middle = std::midpoint(early, late); early < middle && middle < late;
       middle = std::midpoint(early, late)) {
    (parameter_at(middle) < s ? early : late) = middle;
  }
  return late;
}

}  // namespace isocnc::motion
