#pragma once

#include <memory>
#include <optional>
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
  std::shared_ptr<const Stock> stock;
  geometry::Vec3 shift = geometry::Vec3::Zero();  ///< mm
  bool is_turned_over = false;
  int quarter_turns = 0;  ///< Counterclockwise seen from above; any number.
};

/// The material before the first cut, workpiece frame. A mesh is closed. It, or an earlier stock, is read while the
/// stock is made, no later.
using Blank = std::variant<solids::Cuboid, solids::Cylinder, const solids::Mesh*, LeftStock>;

/// A rectangle in X and Y, workpiece frame, mm: the part of a blank that is looked at. It has an area.
using Window = Eigen::AlignedBox<double, 2>;

solids::BoundingBox bounds_of(const Blank& blank);
/// Of the part in the window; empty if that is nothing.
solids::BoundingBox bounds_of(const Blank& blank, const std::optional<Window>& window);

/// The grid over a blank (grid_over). That of an earlier stock whose dexels are as near as `spacing` asks has a dexel
/// for each of them, unless there is a window: then nothing is lost. Else it takes the nearest ones.
DexelGrid grid_over(const Blank& blank, double spacing, const std::optional<Window>& window = {});

/// The tile of a blank that holds the dexels of `grid`.
Tile tile_of(const Blank& blank, const DexelGrid& grid);

}  // namespace isocnc::stock
