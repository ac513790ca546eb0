#include "interpreter/motion/stretch.h"

#include <algorithm>

namespace isocnc::motion {

/// Derivatives in time of what a jet says in s.
static Jet in_time(const Jet& jet, double speed, double acceleration) {
  return {jet.value, speed * jet.first, speed * speed * jet.second + acceleration * jet.first};
}

static Sample sample(const Jet& tip, const Jet& joints, double time) {
  Sample result{.time = time,
                .tip = pose(tip.value),
                .joints = joints.value,
                .joint_speeds = joints.first,
                .joint_accelerations = joints.second,
                .speed = tip.first.head<3>().norm()};
  if (result.speed > 0) result.acceleration = tip.first.head<3>().dot(tip.second.head<3>()) / result.speed;
  return result;
}

Sample Stretch::at(const Kinematics& kinematics, double time) const {
  double t = std::clamp(time - start, 0.0, duration);
  std::size_t i = 0;
  while (i + 1 < static_cast<std::size_t>(phase_count) && t > phases[i].duration) t -= phases[i++].duration;
  const Phase& phase = phases[i];
  t = std::min(t, phase.duration);
  const double s = phase.from + t * (phase.speed + t * phase.acceleration / 2);
  const double speed = phase.speed + t * phase.acceleration;
  return sample(in_time(path.tip_at(kinematics, s), speed, phase.acceleration),
                in_time(path.joints_at(kinematics, s), speed, phase.acceleration),
                std::clamp(time, start, start + duration));
}

}  // namespace isocnc::motion
