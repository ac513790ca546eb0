#pragma once

#include <vector>

#include "interpreter/solids/obstacle.h"
#include "interpreter/stock/stock.h"

namespace isocnc::stock {

/// The surface of what remains, as triangles for solids::write_stl: closed, with corners counterclockwise seen from
/// outside. Each interval of a dexel is a block as wide as its cell, so walls are steps of the spacing, and the
/// enclosed volume is volume(). Takes 72 bytes for each triangle: four or more for each dexel whose neighbors differ
/// from it, two for the upper and two for the lower face of a tile that is the same all over, and so are the tiles
/// around it. Further memory is that of three rows of tiles, some 50 bytes for each of their dexels.
std::vector<solids::Triangle> surface_of(const Stock& stock);

}  // namespace isocnc::stock
