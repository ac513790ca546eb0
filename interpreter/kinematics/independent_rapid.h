#pragma once

#include <vector>

#include "interpreter/kinematics/machine.h"
#include "interpreter/kinematics/move.h"
#include "interpreter/kinematics/path.h"

namespace isocnc::kinematics {

/// A part of a rapid in which each joint has one jerk. On a line s changes as the joints do, on a curve in proportion
/// to the time.
struct RapidPart {
  Path path;                ///< s runs from 0 to `length`.
  double length = 0;        ///< Range of s, mm or degrees. Those of all parts add up to programmed_line().length.
  double duration = 0;      ///< Duration, s.
  double speed = 0;         ///< ds/dt at the start, mm/s or degrees/s.
  double acceleration = 0;  ///< Second derivative of s at the start.
  double jerk = 0;          ///< Third derivative of s.
};

/// Returns whether each joint makes this move by itself: a rapid on a machine with RapidMotion::Independent.
bool moves_independently(const Machine& machine, const Move& move);

/// Returns whether such a move leaves the straight line of the joints between its ends: more than one joint moves.
bool leaves_line(const Machine& machine, const Move& move);

/// Returns the parts of such a move: each joint makes its way in the shortest time that its own speed, acceleration and
/// jerk allow, from rest to rest, and all joints start at once. There are at most 35 parts, and none if no joint moves.
std::vector<RapidPart> independent_rapid(const Machine& machine, const Move& move);

}  // namespace isocnc::kinematics
