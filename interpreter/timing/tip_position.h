#pragma once

#include "interpreter/kinematics/kinematics.h"
#include "interpreter/kinematics/move.h"
#include "interpreter/running/event.h"

namespace isocnc::timing {

/// The length of a tool, from the spindle nose to the tip.
struct ToolLength {
  double mm = 0;  ///< 0 where it is not known, and of the empty spindle.
  bool is_known = true;
};

/// How far the tip is from where a run has it: lengths that are not known, times these vectors of the machine frame.
struct UnknownOffset {
  geometry::Vec3 by_tool = geometry::Vec3::Zero();  ///< By the length of the mounted tool, if that is not known.
  geometry::Mat3 along = geometry::Mat3::Zero();    ///< By the lengths of tools before it: along each column.

  bool is_zero() const { return by_tool.isZero(0) && along.isZero(0); }
};

/// Actual and programmed position of the tip. A tool change moves no joint, so the tip of a longer tool is lower after
/// it. The program continues from the old position: axes that the next motions omit, or move by a distance (G91), keep
/// the difference, and axes with coordinates reach those (I.3.4, D33).
///
/// A tool whose length is not known has a length of 0. Where its motions lead the spindle is not known, and after it
/// has been changed, neither is where the next tool is, along the axes that have not got a coordinate since.
class TipPosition {
 public:
  explicit TipPosition(const geometry::Pose& home) : programmed_(home) {}
  /// `tip`, `programmed` and the axes of the frame in force are in the machine frame.
  TipPosition(const geometry::Pose& tip, const geometry::Pose& programmed, const ToolLength& tool,
              const geometry::Mat3& frame_axes, const UnknownOffset& unknown = {})
      : programmed_(programmed),
        off_program_(tip.tip - programmed.tip),
        frame_axes_(frame_axes),
        tool_(tool),
        is_unknown_off_(!unknown.is_zero()),
        unknown_(unknown) {}

  /// Moves to the end of a motion. Shifts `planned`, which starts and ends at programmed positions, to the path the
  /// machine takes.
  void follow(const running::MoveEvent& move, kinematics::Move& planned);
  void take(const running::FrameEvent& frame) { frame_axes_ = frame.face.axes; }
  /// Changes the tool without moving the joints.
  void mount(const kinematics::Kinematics& kinematics, const ToolLength& tool);

  geometry::Pose tip() const { return {programmed_.tip + off_program_, programmed_.b, programmed_.c}; }
  kinematics::Coordinates joints(const kinematics::Kinematics& kinematics) const {
    return kinematics::inverse(kinematics, kinematics::coordinates(tip()), tool_.mm);
  }
  double tool_length() const { return tool_.mm; }
  bool is_length_known() const { return tool_.is_known; }
  /// Null where it is 0.
  const UnknownOffset* unknown_offset() const { return is_unknown_off_ ? &unknown_ : nullptr; }
  /// Whether joints() are right.
  bool is_place_known(const kinematics::Kinematics& kinematics) const {
    return is_unknown_off_ ? !tool_.is_known && is_spindle_known(kinematics) : tool_.is_known;
  }

 private:
  geometry::Vec3 tool_axis(const kinematics::Kinematics& kinematics) const;
  bool is_spindle_known(const kinematics::Kinematics& kinematics) const;
  void add_unknown(const geometry::Vec3& along);
  void keep_unknown(const geometry::Mat3& kept);

  geometry::Pose programmed_;                               ///< Programmed position, machine frame.
  geometry::Vec3 off_program_ = geometry::Vec3::Zero();     ///< Vector from the programmed position to the tip.
  geometry::Mat3 frame_axes_ = geometry::Mat3::Identity();  ///< Axes of the frame in force, machine frame.
  ToolLength tool_;
  bool is_unknown_off_ = false;  ///< Whether that is not 0:
  UnknownOffset unknown_;
};

}  // namespace isocnc::timing
