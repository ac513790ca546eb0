#pragma once

#include <array>
#include <cstdint>

#include "interpreter/geometry/vectors.h"
#include "interpreter/kinematics/path.h"

namespace isocnc::motion {

/// A time interval in which the path parameter s changes with constant jerk. s is in mm, or in degrees where B and C
/// alone move; the members below name mm only.
struct Phase {
  double duration = 0;      ///< Length of the interval, s.
  double from = 0;          ///< Path parameter s at the start, mm.
  double speed = 0;         ///< ds/dt at the start, mm/s.
  double acceleration = 0;  ///< Second derivative of s at the start, mm/s^2.
  double jerk = 0;          ///< Third derivative of s, mm/s^3; 0 where jerk is not limited.

  /// Returns the rest of the phase, from `time` seconds after its start.
  Phase after(double time) const;
};

/// Position and motion of the machine at one moment.
struct Sample {
  double time = 0;                                                   ///< Time since the planner's start, s.
  geometry::Pose tip;                                                ///< Pose of the tip, machine frame.
  kinematics::Coordinates joints = kinematics::Coordinates::Zero();  ///< Positions of the joints, mm and degrees.
  /// First and second derivatives of `joints` in time. Only tests read them: they hold each axis against its limits.
  kinematics::Coordinates joint_speeds = kinematics::Coordinates::Zero();         ///< mm/s and degrees/s.
  kinematics::Coordinates joint_accelerations = kinematics::Coordinates::Zero();  ///< mm/s^2 and degrees/s^2.
  double speed = 0;         ///< Speed of the tip, mm/s; 0 where B and C alone move.
  double acceleration = 0;  ///< Acceleration along the tip's path, mm/s^2.
};

/// How long a stretch takes, and of which move it is.
struct StretchTime {
  std::uint64_t tag = 0;   ///< Move::tag of the move.
  double duration = 0;     ///< s.
  bool ends_move = false;  ///< Whether this is the last stretch of its move.
};

/// A piece of path, or a part of one, with its motion in time. The class has value semantics and refers to no other
/// object, so it can be evaluated at any time. The stretches of a program follow one another without gaps in place, and
/// without gaps in time except for rests.
struct Stretch : StretchTime {
  double start = 0;             ///< Time since the planner's start, s.
  kinematics::Path path;        ///< Curve that the phases run along.
  std::array<Phase, 3> phases;  ///< Motion of the path parameter; the first `phase_count` are used.
  int phase_count = 0;

  /// Returns the sample at `time` seconds since the planner's start. Times outside the stretch are clamped to it.
  Sample at(const kinematics::Kinematics& kinematics, double time) const;
  /// Returns the path parameter at that time. It never decreases as time grows.
  double parameter_at(double time) const;
  /// Returns the time at which the path parameter reaches `s`, clamped to the stretch.
  double time_at(double s) const;
};

}  // namespace isocnc::motion
