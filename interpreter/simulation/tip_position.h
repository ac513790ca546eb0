#pragma once

#include "interpreter/kinematics/kinematics.h"
#include "interpreter/kinematics/move.h"
#include "interpreter/running/event.h"

namespace isocnc::simulation {

/// Actual and programmed position of the tip. A tool change moves no joint, so the tip of a longer tool is lower after
/// it. The program continues from the old position: axes that the next motions omit, or move by a distance (G91), keep
/// the difference, and axes with coordinates reach those (I.3.4, D33).
class TipPosition {
 public:
  explicit TipPosition(const geometry::Pose& home) : programmed_(home) {}
  /// `tip`, `programmed` and the axes of the frame in force are in the machine frame.
  TipPosition(const geometry::Pose& tip, const geometry::Pose& programmed, double tool_length,
              const geometry::Mat3& frame_axes)
      : programmed_(programmed),
        off_program_(tip.tip - programmed.tip),
        frame_axes_(frame_axes),
        tool_length_(tool_length) {}

  /// Moves to the end of a motion. Shifts `planned`, which starts and ends at programmed positions, to the path the
  /// machine takes.
  void follow(const running::MoveEvent& move, kinematics::Move& planned);
  void take(const running::FrameEvent& frame) { frame_axes_ = frame.face.axes; }
  /// Changes the tool without moving the joints.
  void mount(const kinematics::Kinematics& kinematics, double tool_length);

  geometry::Pose tip() const { return {programmed_.tip + off_program_, programmed_.b, programmed_.c}; }
  kinematics::Coordinates joints(const kinematics::Kinematics& kinematics) const {
    return kinematics::inverse(kinematics, kinematics::coordinates(tip()), tool_length_);
  }
  double tool_length() const { return tool_length_; }

 private:
  geometry::Pose programmed_;                               ///< Programmed position, machine frame.
  geometry::Vec3 off_program_ = geometry::Vec3::Zero();     ///< Vector from the programmed position to the tip.
  geometry::Mat3 frame_axes_ = geometry::Mat3::Identity();  ///< Axes of the frame in force, machine frame.
  double tool_length_ = 0;
};

}  // namespace isocnc::simulation
