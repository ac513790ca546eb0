#pragma once

#include <array>
#include <vector>

#include "interpreter/geometry/frame.h"
#include "interpreter/geometry/range.h"
#include "interpreter/kinematics/machine.h"
#include "interpreter/kinematics/move.h"

namespace isocnc::kinematics {

/// Rounding that does not count as leaving a range, mm or degrees.
inline constexpr double kTravelSlack = 1e-6;

/// A joint that leaves its range, at the place of the move's path where it is farthest outside.
struct Overtravel {
  MachineAxis axis = kX;
  double part = 0;      ///< Part of the path from the move's start, 0 to 1.
  double position = 0;  ///< Position of the joint, mm or degrees.
  double limit = 0;     ///< End of the range that the joint passes, mm or degrees.
};

/// Returns the joints that leave their range on the programmed path, in order of axes; each at most once below its
/// range and once above. The whole path is checked, with the bulges of arcs and the swings of the pivot.
std::vector<Overtravel> overtravels(const Machine& machine, const Move& move);

/// Length and extents of the tip's path: of the programmed path, or for a rapid that turns B or C or whose joints move
/// independently, of the path on which the joints carry the tip.
struct TipTravel {
  double length = 0;                       ///< Length of the tip's path, mm.
  std::array<geometry::Range, 3> extents;  ///< Ranges of X, Y and Z of the tip, machine frame, mm.
};

TipTravel tip_travel(const Machine& machine, const Move& move);

/// Returns the ranges of X, Y and Z of the tip on that path, in coordinates of `frame`, which is given in the machine
/// frame.
std::array<geometry::Range, 3> tip_extents(const Machine& machine, const Move& move, const geometry::Frame& frame);

}  // namespace isocnc::kinematics
