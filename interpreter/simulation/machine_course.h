#pragma once

#include <functional>

#include "interpreter/simulation/compensation.h"
#include "interpreter/simulation/tip_position.h"

namespace isocnc::simulation {

/// Where the machine goes in a run, without times: under G41 and G42 beside the contour, and off the program after a
/// change to a tool of another length. A value: a copy goes on by itself.
class MachineCourse {
 public:
  struct Listeners {
    std::function<void(const running::Event&, const motion::Move&)> move;  ///< The event is a MoveEvent, of the tool.
    /// With the place of the tip, machine frame. May be left out.
    std::function<void(const running::FrameEvent&, const geometry::Vec3&)> frame;
  };

  /// Keeps a reference to the machine. `home` is where the spindle nose stands, machine frame.
  MachineCourse(const TimedMachine& machine, const geometry::Pose& home)
      : machine_(&machine), compensation_(machine), position_(home) {}

  /// Motions under compensation are reported once the contour after them is known.
  void take(const running::Event& event, const Listeners& listeners);
  /// As if nothing followed: the tool stops beside the end of the contour so far.
  void finish(const Listeners& listeners) { compensation_.finish(compensated(listeners)); }

  /// After the motions reported; machine frame.
  geometry::Pose tip() const { return position_.tip(); }
  /// Whether motions wait for what follows.
  bool holds_motions() const { return compensation_.holds_motions(); }
  /// Whether compensation has led the tool off the programmed path, to which no motion has led it back.
  bool is_beside_contour() const { return compensation_.is_beside_contour(); }

 private:
  Compensation::Listeners compensated(const Listeners& listeners);
  void go(const running::Event& event, const Listeners& listeners);

  const TimedMachine* machine_;
  Compensation compensation_;
  TipPosition position_;
};

}  // namespace isocnc::simulation
