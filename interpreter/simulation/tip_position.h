#pragma once

#include "interpreter/motion/kinematics.h"
#include "interpreter/motion/move.h"
#include "interpreter/running/event.h"

namespace isocnc::simulation {

/// Where the tip is, and where its motions have led it. A tool change moves no joint, so the tip of a longer tool is
/// lower after it. The program goes on from the old place: axes that the next motions leave out, or move by a distance
/// (G91), stay off it, and those that are given come to where they are sent (I.3.4, D33).
class TipPosition {
 public:
  explicit TipPosition(const geometry::Pose& home) : programmed_(home) {}
  /// `tip` and `programmed` are in the machine frame, as are the axes of the frame in force.
  TipPosition(const geometry::Pose& tip, const geometry::Pose& programmed, double tool_length,
              const geometry::Mat3& frame_axes)
      : programmed_(programmed),
        off_program_(tip.tip - programmed.tip),
        frame_axes_(frame_axes),
        tool_length_(tool_length) {}

  /// Goes to the end of a motion. `planned`, which begins and ends where the program has it, is shifted to where the
  /// machine makes it.
  void follow(const running::MoveEvent& move, motion::Move& planned);
  void take(const running::FrameEvent& frame) { frame_axes_ = frame.face.axes; }
  /// The joints stay where they are.
  void mount(const motion::Kinematics& kinematics, double tool_length);

  geometry::Pose tip() const { return {programmed_.tip + off_program_, programmed_.b, programmed_.c}; }
  motion::Coordinates joints(const motion::Kinematics& kinematics) const {
    return motion::inverse(kinematics, motion::coordinates(tip()), tool_length_);
  }
  double tool_length() const { return tool_length_; }

 private:
  geometry::Pose programmed_;                               ///< Where the motions have led it, machine frame.
  geometry::Vec3 off_program_ = geometry::Vec3::Zero();     ///< From there to the tip.
  geometry::Mat3 frame_axes_ = geometry::Mat3::Identity();  ///< Of the frame in force, machine frame.
  double tool_length_ = 0;
};

}  // namespace isocnc::simulation
