#include "tests/motion/programs.h"

namespace isocnc::motion {

std::vector<Stretch> plan(const kinematics::Machine& machine, const std::vector<kinematics::Move>& moves) {
  std::vector<Stretch> stretches;
  Planner planner(machine);
  const auto take = [&] {
    while (const Stretch* stretch = planner.next()) stretches.push_back(*stretch);
  };
  for (const kinematics::Move& move : moves) {
    planner.push(move);
    take();
  }
  planner.rest();
  take();
  return stretches;
}

double cycle_time(const std::vector<Stretch>& stretches) {
  return stretches.empty() ? 0 : stretches.back().start + stretches.back().duration;
}

}  // namespace isocnc::motion
