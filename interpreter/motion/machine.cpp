#include "interpreter/motion/machine.h"

namespace isocnc::motion {

Machine three_axis_router() {
  Machine machine;
  machine.axes[kX] = {.least = -100, .most = 3300, .speed = 1000, .acceleration = 3000};
  machine.axes[kY] = {.least = -100, .most = 1700, .speed = 1000, .acceleration = 4000};
  machine.axes[kZ] = {.least = -50, .most = 850, .speed = 500, .acceleration = 5000};
  machine.axes[kB] = {.least = 0, .most = 0, .speed = 180, .acceleration = 900};
  machine.axes[kC] = {.least = 0, .most = 0, .speed = 180, .acceleration = 900};
  return machine;
}

Machine head_router() {
  Machine machine = three_axis_router();
  machine.axes[kX].least = -400;
  machine.axes[kX].most = 3600;
  machine.axes[kY].least = -400;
  machine.axes[kY].most = 2000;
  machine.axes[kZ].least = -400;
  machine.axes[kB] = {.least = -120, .most = 120, .speed = 150, .acceleration = 800};
  machine.axes[kC] = {.least = -360, .most = 360, .speed = 180, .acceleration = 1000};
  machine.kinematics.kind = MachineKind::Head;
  machine.kinematics.pivot = 180;
  return machine;
}

Machine table_router() {
  Machine machine = three_axis_router();
  machine.axes[kX] = {.least = -600, .most = 600, .speed = 800, .acceleration = 4000};
  machine.axes[kY] = {.least = -600, .most = 600, .speed = 800, .acceleration = 4000};
  machine.axes[kZ] = {.least = -400, .most = 800, .speed = 500, .acceleration = 4000};
  machine.axes[kB] = {.least = -120, .most = 120, .speed = 90, .acceleration = 500};
  machine.axes[kC] = {.least = -360, .most = 360, .speed = 180, .acceleration = 900};
  machine.kinematics.kind = MachineKind::Table;
  machine.kinematics.b_point = {0, 0, 50};
  return machine;
}

Machine default_machine() { return head_router(); }

}  // namespace isocnc::motion
