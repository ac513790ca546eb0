#pragma once

#include <variant>
#include <vector>

#include "interpreter/solids/mesh.h"
#include "interpreter/solids/obstacle.h"
#include "interpreter/stock/grid.h"

namespace isocnc::stock {

/// The material before the first cut, workpiece frame. A mesh is closed, and is read while the stock is made, no later.
using Blank = std::variant<solids::Cuboid, solids::Cylinder, const solids::Mesh*>;

solids::BoundingBox bounds_of(const Blank& blank);

/// The tile of a blank that holds the dexels of `grid`.
Tile tile_of(const Blank& blank, const DexelGrid& grid);

}  // namespace isocnc::stock
