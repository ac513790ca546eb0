#pragma once

#include <array>
#include <cstdint>

#include "interpreter/geometry/vectors.h"
#include "interpreter/motion/path.h"

namespace isocnc::motion {

/// A time of constant jerk along a path's parameter.
struct Phase {
  double duration = 0;
  double from = 0;          ///< s at its begin.
  double speed = 0;         ///< ds/dt at its begin.
  double acceleration = 0;  ///< Of s, at its begin.
  double jerk = 0;          ///< Of s; 0 where jerk is not limited.

  /// After `time` from its begin.
  Phase after(double time) const;
};

/// Where the machine is, and how it moves.
struct Sample {
  double time = 0;
  geometry::Pose tip;  ///< Machine frame.
  Coordinates joints = Coordinates::Zero();
  Coordinates joint_speeds = Coordinates::Zero();
  Coordinates joint_accelerations = Coordinates::Zero();
  double speed = 0;         ///< Of the tip, mm/s; 0 where B and C alone turn.
  double acceleration = 0;  ///< Along the tip's path, mm/s^2.
};

/// A piece of a move with its motion in time. A value: it refers to nothing, and any moment of it can be asked for at
/// any time. The stretches of a program follow one another without gap, but for rests, in time and in place.
struct Stretch {
  std::uint64_t tag = 0;   ///< Of the move.
  bool ends_move = false;  ///< The last of its move.
  double start = 0;        ///< Seconds from the planner's beginning.
  double duration = 0;
  Path path;
  std::array<Phase, 3> phases;
  int phase_count = 0;

  /// At `time` since the planner's beginning, held to the stretch.
  Sample at(const Kinematics& kinematics, double time) const;
  /// The path's parameter at that time; it never falls.
  double parameter_at(double time) const;
  /// When the path's parameter comes to `s`, held to the stretch.
  double time_at(double s) const;
};

}  // namespace isocnc::motion
