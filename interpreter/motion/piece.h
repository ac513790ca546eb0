#pragma once

#include <cstdint>

#include "interpreter/kinematics/path.h"

namespace isocnc::motion {

/// A part of the machine's path that belongs to one move: an element after rounding, a part of a curved element, or a
/// part of a blend.
struct Piece {
  kinematics::Path path;
  double begin = 0;        ///< Path parameter s at the start of the piece, mm or degrees.
  double length = 0;       ///< Range of s, mm or degrees.
  std::uint64_t tag = 0;   ///< Move::tag of the move.
  bool ends_move = false;  ///< Whether this is the last piece of its move.
};

}  // namespace isocnc::motion
