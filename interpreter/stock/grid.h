#pragma once

#include "interpreter/geometry/vectors.h"
#include "interpreter/solids/obstacle.h"
#include "interpreter/stock/tile.h"

namespace isocnc::stock {

/// The most columns, and the most rows, of a grid.
inline constexpr int kMaxDexelsAcross = 1 << 17;

/// A rectangle of dexels, workpiece frame, mm.
struct DexelGrid {
  geometry::Vec2 first = geometry::Vec2::Zero();    ///< Place of the dexel in column 0 of row 0.
  geometry::Vec2 spacing = geometry::Vec2::Ones();  ///< Between columns and between rows.
  geometry::Vec2 per_mm = geometry::Vec2::Ones();   ///< 1 / spacing.
  int columns = 0;
  int rows = 0;

  double x(int column) const { return first.x() + column * spacing.x(); }
  double y(int row) const { return first.y() + row * spacing.y(); }
  double cell() const { return spacing.x() * spacing.y(); }  ///< Area that a dexel stands for, mm^2.

  /// The first column at `x` or above; `columns` if there is none. A run of columns from first_column(a) up to, and
  /// without, first_column(b) is that of [a, b). So a slot of 20 mm is 40 dexels of 0.5 mm wide wherever it lies.
  int first_column(double x) const { return first_at((x - first.x()) * per_mm.x(), columns); }
  int first_row(double y) const { return first_at((y - first.y()) * per_mm.y(), rows); }

  int tile_columns() const { return (columns + Tile::kSize - 1) / Tile::kSize; }
  int tile_rows() const { return (rows + Tile::kSize - 1) / Tile::kSize; }
  /// The part of the grid that a tile holds.
  DexelGrid tile(int tile_column, int tile_row) const;

 private:
  static int first_at(double at, int size) {
    if (!(at > 0)) return 0;
    if (at > size) return size;
    const int whole = static_cast<int>(at);
    return whole < at ? whole + 1 : whole;
  }
};

/// The grid of `columns` x `rows` equal cells over a rectangle, with a dexel in the middle of each.
DexelGrid grid_of(const solids::BoundingBox& bounds, int columns, int rows);

/// The grid over a rectangle: dexels in the middle of cells that divide both sides evenly, `spacing` wide or less. So
/// the volume of a box is exact. At most kMaxDexelsAcross columns and rows, whatever the spacing.
DexelGrid grid_over(const solids::BoundingBox& bounds, double spacing);

}  // namespace isocnc::stock
