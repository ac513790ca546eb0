#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "interpreter/stock/blank.h"
#include "interpreter/stock/sweep.h"

namespace isocnc::stock {

/// Runs `work` on one or several threads at once, and returns when all have ended.
using Workers = std::function<void(const std::function<void()>& work)>;

/// Calls `use` once with each number below `count`, on the caller's thread or,
/// if there are workers and more than one number, on theirs. They come from
/// both ends: where numbers mean about the same at each call, as neighboring
/// parts of a workpiece do, most threads come back to what they have had, and
/// its memory is near them.
void for_each_number(const Workers& workers, std::size_t count, const std::function<void(std::size_t number)>& use);

/// Which tile: its column and row.
struct TileIndex {
  int column = 0;
  int row = 0;
  friend bool operator==(const TileIndex&, const TileIndex&) = default;
};

/// What remains of a blank, workpiece frame, mm: vertical dexels in tiles. A value: copies share all tiles that neither
/// has cut since, and cost a pointer.
///
/// Along a dexel, a cut is exact but for 0.001 mm where the axis of the body is at rest. Across, material is known at
/// the dexels alone: every disc of the diameter sqrt(2) spacing() in a horizontal plane holds one.
class Stock {
 public:
  /// Dexels at `spacing` or less (grid_over), of the part of the blank in a window if there is one. See
  /// required_memory() first: nothing here refuses a fine spacing, except that there are at most 2^17 columns and rows.
  Stock(const Blank& blank, double spacing, const std::optional<Window>& window = {});
  /// A stock of given tiles, none of them null: row by row, and as many as grid_of(bounds, columns, rows) has.
  Stock(const solids::BoundingBox& bounds, int columns, int rows, std::vector<std::shared_ptr<Tile>> tiles);

  /// Applies the sweeps in their order, and returns the outcome of each. Stock and outcomes are the same to the last
  /// bit for any number of threads, and, but for the depths of those that find, for any division of the sweeps into
  /// calls. Without `workers`, works on the caller's thread. Other threads may use copies of the stock meanwhile.
  std::vector<SweepOutcome> apply(std::span<const Sweep> sweeps, const Workers& workers = {});

  const DexelGrid& grid() const { return tree_->grid; }
  double spacing() const { return grid().spacing.maxCoeff(); }
  /// Those of the blank, or of its part in the window.
  const solids::BoundingBox& bounds() const { return tree_->bounds; }
  const Tile& tile(const TileIndex& index) const { return *tile_at(index); }

  double volume() const;           ///< mm^3
  std::size_t memory() const;      ///< Bytes of all tiles, whether shared or not.
  std::size_t own_memory() const;  ///< Bytes of the tiles that no copy shares.

  /// The material of the dexel nearest to (x, y), from the lowest interval up; none outside the grid.
  std::vector<HeightInterval> intervals_at(double x, double y) const;
  /// The highest material in the dexel nearest to a point that is not above the point; its top is the point's z if that
  /// is within.
  std::optional<HeightInterval> first_below(const geometry::Vec3& point) const;
  /// The tag of the sweep that last cut the dexel nearest to (x, y).
  std::optional<CutTag> cut_by(double x, double y) const;

  /// The tiles in which this stock may differ from another copy of the same blank, in order. A view that keeps a copy
  /// of what it shows asks for these, forwards or back in time.
  std::vector<TileIndex> tiles_changed_since(const Stock& shown) const;

 private:
  static constexpr int kNodeSize = 8;
  using TilePointer = std::shared_ptr<Tile>;
  struct Node {
    std::array<TilePointer, static_cast<std::size_t>(kNodeSize) * kNodeSize> tiles;
  };
  struct Tree {
    DexelGrid grid;
    solids::BoundingBox bounds;
    int node_columns = 0;
    std::vector<std::shared_ptr<Node>> nodes;
  };

  Stock(const solids::BoundingBox& bounds, const DexelGrid& over);
  std::vector<SweepOutcome> apply_together(std::span<const Sweep> sweeps, const Workers& workers);
  const TilePointer& tile_at(const TileIndex& index) const;
  TilePointer& tile_to_cut(const TileIndex& index);
  void own(std::span<const TileIndex> tiles);
  std::optional<std::array<int, 2>> nearest_dexel(double x, double y) const;

  std::shared_ptr<Tree> tree_;
};

/// Calls `use` with each dexel whose material differs between two copies of the same blank, in order of the tiles.
/// Takes time for the tiles that have changed alone.
void for_each_change(const Stock& old, const Stock& now, const std::function<void(int row, int column)>& use);

/// Bytes that a stock takes when every dexel has been cut and has one interval; further intervals, as undercuts leave
/// them, take 12 each. Infinite if the spacing is not positive.
double required_memory(const Blank& blank, double spacing, const std::optional<Window>& window = {});

/// The smallest spacing, mm, of which the required memory is at most `limit` bytes, up to 1 %.
double fitting_spacing(const Blank& blank, double limit, const std::optional<Window>& window = {});

}  // namespace isocnc::stock
