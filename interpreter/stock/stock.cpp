#include "interpreter/stock/stock.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace isocnc::stock {

using geometry::Vec3;

namespace {

constexpr double kBytesOfDexel = sizeof(float) + sizeof(CutTag);

/// Whether no one else holds what the pointer holds. What another holder did before it let go has then happened.
template <class Held>
bool is_only_holder(const std::shared_ptr<Held>& pointer) {
  if (pointer.use_count() != 1) return false;
  std::atomic_thread_fence(std::memory_order_acquire);
  return true;
}

template <class Use>
void for_each_tile(const DexelGrid& grid, Use&& use) {
  for (int row = 0; row < grid.tile_rows(); ++row)
    for (int column = 0; column < grid.tile_columns(); ++column) use(TileIndex{column, row});
}

}  // namespace

Stock::Stock(const Blank& blank, double spacing, const std::optional<Window>& window)
    : Stock(bounds_of(blank, window), grid_over(blank, spacing, window)) {
  std::map<std::array<int, 2>, TilePointer> uniform;  // By columns and rows.
  for_each_tile(grid(), [&](const TileIndex& index) {
    const DexelGrid part = grid().tile(index.column, index.row);
    TilePointer& shared = uniform[{part.columns, part.rows}];
    TilePointer& tile = tile_to_cut(index);
    if (shared && std::holds_alternative<solids::Cuboid>(blank)) {
      tile = shared;
      return;
    }
    tile = std::make_shared<Tile>(tile_of(blank, part));
    if (!tile->is_uniform()) return;
    if (shared && shared->floor() == tile->floor() && shared->ceiling() == tile->ceiling()) tile = shared;
    shared = tile;
  });
}

Stock::Stock(const solids::BoundingBox& bounds, int columns, int rows, std::vector<std::shared_ptr<Tile>> tiles)
    : Stock(bounds, grid_of(bounds, columns, rows)) {
  std::size_t next = 0;
  for_each_tile(grid(), [&](const TileIndex& index) { tile_to_cut(index) = std::move(tiles[next++]); });
}

Stock::Stock(const solids::BoundingBox& bounds, const DexelGrid& over) : tree_(std::make_shared<Tree>()) {
  tree_->bounds = bounds;
  tree_->grid = over;
  const auto nodes_across = [](int tiles) { return (tiles + kNodeSize - 1) / kNodeSize; };
  tree_->node_columns = nodes_across(grid().tile_columns());
  tree_->nodes.resize(static_cast<std::size_t>(tree_->node_columns) *
                      static_cast<std::size_t>(nodes_across(grid().tile_rows())));
  for (auto& node : tree_->nodes) node = std::make_shared<Node>();
}

const Stock::TilePointer& Stock::tile_at(const TileIndex& index) const {
  const int node = index.row / kNodeSize * tree_->node_columns + index.column / kNodeSize;
  const int tile = index.row % kNodeSize * kNodeSize + index.column % kNodeSize;
  return tree_->nodes[static_cast<std::size_t>(node)]->tiles[static_cast<std::size_t>(tile)];
}

Stock::TilePointer& Stock::tile_to_cut(const TileIndex& index) { return const_cast<TilePointer&>(tile_at(index)); }

/// Makes the nodes of some tiles those of this copy alone, so that threads can replace the tiles.
void Stock::own(std::span<const TileIndex> tiles) {
  if (tiles.empty()) return;
  if (!is_only_holder(tree_)) tree_ = std::make_shared<Tree>(*tree_);
  for (const TileIndex& index : tiles) {
    const int at = index.row / kNodeSize * tree_->node_columns + index.column / kNodeSize;
    auto& node = tree_->nodes[static_cast<std::size_t>(at)];
    if (!is_only_holder(node)) node = std::make_shared<Node>(*node);
  }
}

double Stock::volume() const {
  double sum = 0;
  for_each_tile(grid(), [&](const TileIndex& index) { sum += tile(index).length(); });
  return sum * grid().cell();
}

std::size_t Stock::memory() const {
  std::size_t bytes = sizeof(Tree) + tree_->nodes.size() * sizeof(Node);
  std::set<const Tile*> seen;
  for_each_tile(grid(), [&](const TileIndex& index) {
    if (seen.insert(&tile(index)).second) bytes += tile(index).memory();
  });
  return bytes;
}

std::size_t Stock::own_memory() const {
  if (tree_.use_count() != 1) return 0;
  std::size_t bytes = sizeof(Tree);
  for (const auto& node : tree_->nodes) {
    if (node.use_count() != 1) continue;
    bytes += sizeof(Node);
    for (const TilePointer& tile : node->tiles)
      if (tile && tile.use_count() == 1) bytes += tile->memory();
  }
  return bytes;
}

/// Column and row in the whole grid.
std::optional<std::array<int, 2>> Stock::nearest_dexel(double x, double y) const {
  const double column = std::round((x - grid().first.x()) / grid().spacing.x());
  const double row = std::round((y - grid().first.y()) / grid().spacing.y());
  if (!(column >= 0 && column < grid().columns && row >= 0 && row < grid().rows)) return {};
  return std::array<int, 2>{static_cast<int>(column), static_cast<int>(row)};
}

std::vector<HeightInterval> Stock::intervals_at(double x, double y) const {
  const auto dexel = nearest_dexel(x, y);
  if (!dexel) return {};
  const auto [column, row] = *dexel;
  return tile({column / Tile::kSize, row / Tile::kSize}).intervals(row % Tile::kSize, column % Tile::kSize);
}

std::optional<HeightInterval> Stock::first_below(const Vec3& point) const {
  std::optional<HeightInterval> found;
  for (const HeightInterval& interval : intervals_at(point.x(), point.y()))
    if (interval.bottom <= point.z()) found = HeightInterval{interval.bottom, std::min(interval.top, point.z())};
  return found;
}

std::optional<CutTag> Stock::cut_by(double x, double y) const {
  const auto dexel = nearest_dexel(x, y);
  if (!dexel) return {};
  const auto [column, row] = *dexel;
  return tile({column / Tile::kSize, row / Tile::kSize}).cut_by(row % Tile::kSize, column % Tile::kSize);
}

std::vector<TileIndex> Stock::tiles_changed_since(const Stock& shown) const {
  std::vector<TileIndex> changed;
  if (tree_ == shown.tree_) return changed;
  const bool is_same_grid = grid().columns == shown.grid().columns && grid().rows == shown.grid().rows;
  for_each_tile(grid(), [&](const TileIndex& index) {
    if (!is_same_grid || tile_at(index) != shown.tile_at(index)) changed.push_back(index);
  });
  return changed;
}

void for_each_change(const Stock& old, const Stock& now, const std::function<void(int row, int column)>& use) {
  const bool is_same_grid = now.grid().columns == old.grid().columns && now.grid().rows == old.grid().rows;
  for (const TileIndex& index : now.tiles_changed_since(old)) {
    const Tile& tile = now.tile(index);
    for (int row = 0; row < tile.rows(); ++row)
      for (int column = 0; column < tile.columns(); ++column)
        if (!is_same_grid || !tile.has_same_material(old.tile(index), row, column))
          use(index.row * Tile::kSize + row, index.column * Tile::kSize + column);
  }
}

double required_memory(const Blank& blank, double spacing, const std::optional<Window>& window) {
  if (!(spacing > 0)) return std::numeric_limits<double>::infinity();
  const Vec3 size = bounds_of(blank, window).sizes();
  const auto tiles_across = [&](double length) {
    return std::ceil(std::max(1.0, std::ceil(length / spacing * (1 - 1e-12))) / Tile::kSize);
  };
  const double lower_ends = std::holds_alternative<solids::Cuboid>(blank) ? 0 : sizeof(float);
  const double dexels = tiles_across(size.x()) * tiles_across(size.y()) * Tile::kSize * Tile::kSize;
  return dexels * (kBytesOfDexel + lower_ends);
}

double fitting_spacing(const Blank& blank, double limit, const std::optional<Window>& window) {
  const Vec3 size = bounds_of(blank, window).sizes();
  double spacing = std::sqrt(std::max(1e-12, size.x() * size.y() * kBytesOfDexel / std::max(1.0, limit)));
  const double coarsest = std::max({1e-6, size.x(), size.y()});
  while (required_memory(blank, spacing, window) > limit && spacing < coarsest) spacing *= 1.01;
  return spacing;
}

}  // namespace isocnc::stock
