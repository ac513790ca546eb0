#pragma once

#include <functional>

#include "interpreter/simulation/compensation.h"
#include "interpreter/timing/tip_position.h"

namespace isocnc::simulation {

/// The path of the machine in a run, without times: offset from the contour under G41 and G42, and off the program
/// after a change to a tool of another length. A value: a copy runs independently.
class MachineCourse {
 public:
  struct Listeners {
    std::function<void(const running::Event&, const kinematics::Move&)>
        move;  ///< The event is a MoveEvent, the motion of the tool.
    /// Called with the position of the tip, machine frame. Optional.
    std::function<void(const running::FrameEvent&, const geometry::Vec3&)> frame;
    std::function<void(const RunWarning&)> warning;  ///< Optional.
  };

  /// Keeps a reference to the machine. `home` is the position of the spindle nose, machine frame.
  MachineCourse(const timing::TimedMachine& machine, const geometry::Pose& home)
      : machine_(&machine), compensation_(machine), position_(home) {}

  /// Motions under compensation are reported once the contour after them is known.
  void take(const running::Event& event, const Listeners& listeners);
  /// Finishes the run here, as at the end of the program: the tool stops at the offset end point of the contour.
  void finish(const Listeners& listeners) { compensation_.finish(compensated(listeners)); }

  /// The tip after the motions reported; machine frame.
  geometry::Pose tip() const { return position_.tip(); }
  /// Whether the tip is there: not with a tool of known length after one of another, unknown length
  /// (timing::TipPosition).
  bool is_tip_known() const { return !position_.unknown_offset() || !position_.is_length_known(); }
  /// Whether motions wait for the ones after them.
  bool holds_motions() const { return compensation_.holds_motions(); }
  /// Whether the tool is off the programmed path because of compensation, and no motion has led it back.
  bool is_beside_contour() const { return compensation_.is_beside_contour(); }

 private:
  Compensation::Listeners compensated(const Listeners& listeners);
  void go(const running::Event& event, const Listeners& listeners);

  const timing::TimedMachine* machine_;
  Compensation compensation_;
  timing::TipPosition position_;
};

}  // namespace isocnc::simulation
