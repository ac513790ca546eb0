#include "interpreter/kinematics/machine.h"

#include <algorithm>

namespace isocnc::kinematics {

bool limits_jerk(const Machine& machine) {
  return std::any_of(machine.axes.begin(), machine.axes.end(),
                     [](const AxisLimits& axis) { return axis.jerk.has_value(); });
}

Machine three_axis_router() {
  Machine machine;
  machine.axes[kX] = {.minimum = -100, .maximum = 3300, .speed = 1000, .acceleration = 3000};
  machine.axes[kY] = {.minimum = -100, .maximum = 1700, .speed = 1000, .acceleration = 4000};
  machine.axes[kZ] = {.minimum = -50, .maximum = 850, .speed = 500, .acceleration = 5000};
  machine.axes[kB] = {.minimum = 0, .maximum = 0, .speed = 180, .acceleration = 900};
  machine.axes[kC] = {.minimum = 0, .maximum = 0, .speed = 180, .acceleration = 900};
  return machine;
}

Machine head_router() {
  Machine machine = three_axis_router();
  machine.axes[kX].minimum = -400;
  machine.axes[kX].maximum = 3600;
  machine.axes[kY].minimum = -400;
  machine.axes[kY].maximum = 2000;
  machine.axes[kZ].minimum = -400;
  machine.axes[kB] = {.minimum = -120, .maximum = 120, .speed = 150, .acceleration = 800};
  machine.axes[kC] = {.minimum = -360, .maximum = 360, .speed = 180, .acceleration = 1000};
  machine.kinematics.kind = MachineKind::Head;
  machine.kinematics.pivot = 180;
  return machine;
}

Machine table_router() {
  Machine machine = three_axis_router();
  machine.axes[kX] = {.minimum = -600, .maximum = 600, .speed = 800, .acceleration = 4000};
  machine.axes[kY] = {.minimum = -600, .maximum = 600, .speed = 800, .acceleration = 4000};
  machine.axes[kZ] = {.minimum = -400, .maximum = 800, .speed = 500, .acceleration = 4000};
  machine.axes[kB] = {.minimum = -120, .maximum = 120, .speed = 90, .acceleration = 500};
  machine.axes[kC] = {.minimum = -360, .maximum = 360, .speed = 180, .acceleration = 900};
  machine.kinematics.kind = MachineKind::Table;
  machine.kinematics.b_point = {0, 0, 50};
  return machine;
}

Machine default_machine() { return head_router(); }

}  // namespace isocnc::kinematics
