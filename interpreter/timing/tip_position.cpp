#include "interpreter/timing/tip_position.h"

#include <Eigen/LU>

namespace isocnc::timing {

using geometry::Mat3;
using geometry::Vec3;

/// Of vectors of about length 1: what is shorter comes from rounding.
static constexpr double kNothing = 1e-9;

/// The step of the tip for each millimeter of the tool, in the machine frame.
Vec3 TipPosition::tool_axis(const kinematics::Kinematics& kinematics) const {
  const kinematics::Coordinates standing = joints(kinematics);
  const auto tip_of = [&](double length) -> Vec3 {
    return kinematics::forward(kinematics, standing, length).head<3>();
  };
  return tip_of(tool_.mm + 1) - tip_of(tool_.mm);
}

/// Whether the spindle is where it was before a tool was mounted whose length is not known.
bool TipPosition::is_spindle_known(const kinematics::Kinematics& kinematics) const {
  return unknown_.along.isZero(0) && !unknown_.by_tool.isZero(0) &&
         (unknown_.by_tool + tool_axis(kinematics)).isZero(kNothing);
}

void TipPosition::add_unknown(const Vec3& along) {
  if (along.isZero(kNothing)) return;
  for (int i = 0; i < 3; ++i) {
    if (unknown_.along.col(i).isZero(0)) {
      unknown_.along.col(i) = along;
      return;
    }
    if (unknown_.along.col(i).cross(along).isZero(kNothing)) return;
  }
  unknown_.along = Mat3::Identity();
}

/// Applies what a motion keeps of the distances to the program.
void TipPosition::keep_unknown(const Mat3& kept) {
  unknown_.by_tool = kept * unknown_.by_tool;
  if (unknown_.by_tool.isZero(kNothing)) unknown_.by_tool.setZero();
  unknown_.along = kept * unknown_.along;
  for (int i = 0; i < 3; ++i)
    if (unknown_.along.col(i).isZero(kNothing)) unknown_.along.col(i).setZero();
  is_unknown_off_ = !unknown_.is_zero();
}

void TipPosition::follow(const running::MoveEvent& move, kinematics::Move& planned) {
  programmed_ = move.to;
  if (off_program_ == Vec3::Zero() && !is_unknown_off_) return;
  planned.from.tip += off_program_;
  const Mat3 to_frame = frame_axes_.inverse();
  const auto is_placed = [&](int axis) {
    return (move.placed & execution::axis_bit(static_cast<execution::Axis>(axis))) != 0;
  };
  Vec3 kept = to_frame * off_program_;
  for (int axis = 0; axis < 3; ++axis)
    if (is_placed(axis)) kept[axis] = 0;
  off_program_ = frame_axes_ * kept;
  if (is_unknown_off_) {
    const Vec3 shares(is_placed(0) ? 0 : 1, is_placed(1) ? 0 : 1, is_placed(2) ? 0 : 1);
    keep_unknown(frame_axes_ * shares.asDiagonal() * to_frame);
  }
  planned.to.tip += off_program_;
  planned.center += off_program_;
}

void TipPosition::mount(const kinematics::Kinematics& kinematics, const ToolLength& tool) {
  if (!tool.is_known || !tool_.is_known) {
    const Vec3 axis = tool_axis(kinematics);
    if (!tool_.is_known) add_unknown(unknown_.by_tool + axis);
    unknown_.by_tool = tool.is_known ? Vec3::Zero() : Vec3(-axis);
  }
  if (tool.mm != tool_.mm)
    off_program_ = kinematics::forward(kinematics, joints(kinematics), tool.mm).head<3>() - programmed_.tip;
  tool_ = tool;
  is_unknown_off_ = !unknown_.is_zero();
}

}  // namespace isocnc::timing
