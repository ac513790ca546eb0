#pragma once

#include <vector>

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

}  // namespace isocnc::motion
