#pragma once

#include <vector>

#include "interpreter/solids/obstacle.h"
#include "interpreter/stock/stock.h"

namespace isocnc::stock {

/// The surface of what remains, as triangles for solids::write_stl: closed, with corners counterclockwise seen from
/// outside. Each interval of a dexel is a block as wide as its cell, so walls are steps of the spacing, and the
/// enclosed volume is volume(). Takes 72 bytes for each triangle: four or more for each dexel whose neighbors differ
/// from it, few for large faces.
std::vector<solids::Triangle> surface_of(const Stock& stock);

}  // namespace isocnc::stock
