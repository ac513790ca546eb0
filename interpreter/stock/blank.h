#pragma once

#include <variant>
#include <vector>

#include "interpreter/solids/mesh.h"
#include "interpreter/solids/obstacle.h"
#include "interpreter/stock/grid.h"

namespace isocnc::stock {

class Stock;

/// What an earlier setup has left, as it lies now: turned over about the X axis of its frame, then turned about Z, then
/// shifted.
struct LeftStock {
  const Stock* stock = nullptr;
  geometry::Vec3 shift = geometry::Vec3::Zero();  ///< mm
  bool is_turned_over = false;
  int quarter_turns = 0;  ///< Counterclockwise seen from above; any number.
};

/// The material before the first cut, workpiece frame. A mesh is closed. It, or an earlier stock, is read while the
/// stock is made, no later.
using Blank = std::variant<solids::Cuboid, solids::Cylinder, const solids::Mesh*, LeftStock>;

solids::BoundingBox bounds_of(const Blank& blank);

/// The grid over a blank (grid_over). That of an earlier stock whose dexels are as near as `spacing` asks has a dexel
/// for each of them: then nothing is lost. Else it takes the nearest ones.
DexelGrid grid_over(const Blank& blank, double spacing);

/// The tile of a blank that holds the dexels of `grid`.
Tile tile_of(const Blank& blank, const DexelGrid& grid);

}  // namespace isocnc::stock
