#include "interpreter/simulation/tip_position.h"

#include <Eigen/LU>

namespace isocnc::simulation {

void TipPosition::follow(const running::MoveEvent& move, kinematics::Move& planned) {
  programmed_ = move.to;
  if (off_program_ == geometry::Vec3::Zero()) return;
  planned.from.tip += off_program_;
  geometry::Vec3 kept = frame_axes_.inverse() * off_program_;
  for (int axis = 0; axis < 3; ++axis)
    if ((move.placed & execution::axis_bit(static_cast<execution::Axis>(axis))) != 0) kept[axis] = 0;
  off_program_ = frame_axes_ * kept;
  planned.to.tip += off_program_;
  planned.center += off_program_;
}

void TipPosition::mount(const kinematics::Kinematics& kinematics, double tool_length) {
  if (tool_length == tool_length_) return;
  const kinematics::Coordinates standing = joints(kinematics);
  tool_length_ = tool_length;
  off_program_ = kinematics::forward(kinematics, standing, tool_length).head<3>() - programmed_.tip;
}

}  // namespace isocnc::simulation
