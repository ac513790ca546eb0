#pragma once

#include <cstdint>

#include "interpreter/motion/path.h"

namespace isocnc::motion {

/// A part of a move's path, as the machine goes it.
struct Piece {
  Path path;
  double begin = 0;  ///< Of the path's parameter.
  double length = 0;
  std::uint64_t tag = 0;
  bool ends_move = false;
};

}  // namespace isocnc::motion
