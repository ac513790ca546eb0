#pragma once

#include <array>
#include <vector>

#include "interpreter/geometry/frame.h"
#include "interpreter/geometry/range.h"
#include "interpreter/motion/machine.h"
#include "interpreter/motion/move.h"

namespace isocnc::motion {

/// A joint that leaves its range: where on the move's path it is farthest out.
struct Overtravel {
  Axis axis = kX;
  double part = 0;      ///< Of the way from the move's begin to its end, 0 to 1.
  double position = 0;  ///< Of the joint, mm or degrees.
  double limit = 0;     ///< Which it should not pass.
};

/// Joints that leave their range on the programmed path, by axis, each at most once below and once above: all the way,
/// the bulges of arcs and the swings of the pivot included.
std::vector<Overtravel> overtravels(const Machine& machine, const Move& move);

/// The tip's way on the programmed path, and where the joints of a rapid take it.
struct TipTravel {
  double length = 0;                       ///< mm
  std::array<geometry::Range, 3> extents;  ///< From where to where it goes, machine frame.
};

TipTravel tip_travel(const Machine& machine, const Move& move);

/// From where to where the tip goes on that way, in coordinates of a frame that is given in the machine frame.
std::array<geometry::Range, 3> tip_extents(const Machine& machine, const Move& move, const geometry::Frame& frame);

}  // namespace isocnc::motion
