#include "interpreter/stock/blank.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "interpreter/chords/line_chord.h"
#include "interpreter/stock/stock.h"

namespace isocnc::stock {

using geometry::Vec2;
using geometry::Vec3;
using solids::BoundingBox;

namespace {

constexpr double kMinSize = 1e-9;  ///< Of a grid, mm.

int cells_across(double size, double spacing) {
  const double cells = std::ceil(size / spacing * (1 - 1e-12));
  if (!(cells > 1)) return 1;
  return cells < kMaxDexelsAcross ? static_cast<int>(cells) : kMaxDexelsAcross;
}

/// A dexel of a grid.
struct DexelPlace {
  int row;
  int column;
};

void append(const DexelPlace& dexel, const HeightInterval& z, std::vector<DexelInterval>& material) {
  const auto bottom = static_cast<float>(z.bottom);
  const auto top = static_cast<float>(z.top);
  if (bottom < top) material.push_back({dexel.row, dexel.column, bottom, top});
}

/// Where the lines of a tile cross the surface of a mesh.
struct SurfaceCrossing {
  int dexel;
  double z;
  bool is_entry;  ///< Seen from below.
};

/// Whether a point is to the left of the line from one corner to another, both in the plane. Both triangles at an edge
/// compute the same number, since the edge is always taken from its smaller corner, and a point on the edge is given to
/// one of both.
class PlaneEdge {
 public:
  PlaneEdge(const Vec3& from, const Vec3& to) {
    is_swapped_ = to.x() < from.x() || (to.x() == from.x() && to.y() < from.y());
    start_ = (is_swapped_ ? to : from).head<2>();
    along_ = (is_swapped_ ? from : to).head<2>() - start_;
  }
  bool has_to_its_left(double x, double y) const {
    const double side = along_.x() * (y - start_.y()) - along_.y() * (x - start_.x());
    return is_swapped_ ? side < 0 : side >= 0;
  }

 private:
  Vec2 start_;
  Vec2 along_;
  bool is_swapped_;
};

void cross_triangle(const solids::Triangle& triangle, const DexelGrid& grid, std::vector<SurfaceCrossing>& crossings) {
  const Vec3 normal = triangle.area_vector();
  if (!(std::abs(normal.z()) > 0)) return;
  const bool faces_up = normal.z() > 0;
  const Vec3& a = triangle.corners[0];
  const Vec3& b = triangle.corners[faces_up ? 1 : 2];
  const Vec3& c = triangle.corners[faces_up ? 2 : 1];
  const PlaneEdge ab(a, b);
  const PlaneEdge bc(b, c);
  const PlaneEdge ca(c, a);
  const Vec3 low = a.cwiseMin(b).cwiseMin(c);
  const Vec3 high = a.cwiseMax(b).cwiseMax(c);
  const int last_row = std::min(grid.first_row(high.y()) + 1, grid.rows);
  const int last_column = std::min(grid.first_column(high.x()) + 1, grid.columns);
  for (int row = grid.first_row(low.y()); row < last_row; ++row)
    for (int column = grid.first_column(low.x()); column < last_column; ++column) {
      const double x = grid.x(column);
      const double y = grid.y(row);
      if (!ab.has_to_its_left(x, y) || !bc.has_to_its_left(x, y) || !ca.has_to_its_left(x, y)) continue;
      const double z = a.z() - (normal.x() * (x - a.x()) + normal.y() * (y - a.y())) / normal.z();
      crossings.push_back({row * grid.columns + column, std::clamp(z, low.z(), high.z()), !faces_up});
    }
}

/// Whatever is inside more surfaces than outside is material.
std::vector<DexelInterval> fill_between(std::vector<SurfaceCrossing>& crossings, const DexelGrid& grid) {
  std::vector<DexelInterval> material;
  std::sort(crossings.begin(), crossings.end(), [](const SurfaceCrossing& left, const SurfaceCrossing& right) {
    if (left.dexel != right.dexel) return left.dexel < right.dexel;
    if (left.z != right.z) return left.z < right.z;
    return left.is_entry && !right.is_entry;
  });
  int depth = 0;
  int dexel = -1;
  double bottom = 0;
  for (const SurfaceCrossing& crossing : crossings) {
    if (crossing.dexel != dexel) depth = 0;
    dexel = crossing.dexel;
    if (crossing.is_entry && depth++ == 0) bottom = crossing.z;
    if (crossing.is_entry || depth == 0 || --depth > 0) continue;
    append({dexel / grid.columns, dexel % grid.columns}, {bottom, crossing.z}, material);
  }
  return material;
}

Tile tile_of_mesh(const solids::Mesh& mesh, const DexelGrid& grid) {
  const Vec2 low(grid.x(0), grid.y(0));
  const Vec2 high(grid.x(grid.columns - 1), grid.y(grid.rows - 1));
  std::vector<SurfaceCrossing> crossings;
  std::vector<std::uint32_t> waiting = {0};
  while (!waiting.empty()) {
    const solids::MeshNode& node = mesh.nodes()[waiting.back()];
    waiting.pop_back();
    if ((node.box.max().head<2>().array() < low.array()).any() ||
        (node.box.min().head<2>().array() > high.array()).any())
      continue;
    if (node.count == 0) {
      waiting.push_back(node.first);
      waiting.push_back(node.first + 1);
      continue;
    }
    for (const solids::Triangle& triangle : mesh.triangles().subspan(node.first, node.count))
      cross_triangle(triangle, grid, crossings);
  }
  return {grid.columns, grid.rows, fill_between(crossings, grid)};
}

/// The grid of another blank may reach beyond the box.
Tile tile_of_box(const solids::Cuboid& box, const DexelGrid& grid) {
  const int first_column = grid.first_column(box.minimum.x());
  const int last_column = grid.first_column(box.maximum.x());
  const int first_row = grid.first_row(box.minimum.y());
  const int last_row = grid.first_row(box.maximum.y());
  if (first_column == 0 && first_row == 0 && last_column == grid.columns && last_row == grid.rows)
    return {grid.columns, grid.rows, static_cast<float>(box.minimum.z()), static_cast<float>(box.maximum.z())};
  std::vector<DexelInterval> material;
  for (int row = first_row; row < last_row; ++row)
    for (int column = first_column; column < last_column; ++column)
      append({row, column}, {box.minimum.z(), box.maximum.z()}, material);
  return {grid.columns, grid.rows, material};
}

Tile tile_of_cylinder(const solids::Cylinder& cylinder, const DexelGrid& grid) {
  const chords::FrustumChord chord({0, cylinder.radius, cylinder.height, cylinder.radius}, cylinder.at);
  std::vector<DexelInterval> material;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      append({row, column}, chord.of(Vec2(grid.x(column), grid.y(row))), material);
  return {grid.columns, grid.rows, material};
}

/// Where what is left of an earlier setup was, and how it lies now.
class LeftStockPlace {
 public:
  explicit LeftStockPlace(const LeftStock& left)
      : left_(left), is_turned_aside_(left.quarter_turns % 2 != 0), quarter_turns_((left.quarter_turns % 4 + 4) % 4) {}

  bool is_turned_aside() const { return is_turned_aside_; }
  Vec3 now(const Vec3& then) const {
    const Vec3 p = left_.is_turned_over ? Vec3(then.x(), -then.y(), -then.z()) : then;
    Vec3 result = left_.shift + Vec3(0, 0, p.z());
    result.head<2>() += turned(p.head<2>(), quarter_turns_);
    return result;
  }
  Vec2 then(const Vec2& now) const {
    const Vec2 p = turned(now - left_.shift.head<2>(), 4 - quarter_turns_);
    return left_.is_turned_over ? Vec2(p.x(), -p.y()) : p;
  }
  DexelInterval placed(DexelInterval interval) const {
    if (left_.is_turned_over) std::tie(interval.bottom, interval.top) = std::pair(-interval.top, -interval.bottom);
    interval.bottom = static_cast<float>(interval.bottom + left_.shift.z());
    interval.top = static_cast<float>(interval.top + left_.shift.z());
    return interval;
  }
  BoundingBox bounds() const {
    const Vec3 one = now(left_.stock->bounds().min());
    const Vec3 other = now(left_.stock->bounds().max());
    return {one.cwiseMin(other), one.cwiseMax(other)};
  }

 private:
  static Vec2 turned(Vec2 p, int quarters) {
    for (int i = 0; i < quarters; ++i) p = Vec2(-p.y(), p.x());
    return p;
  }

  const LeftStock& left_;
  bool is_turned_aside_;
  int quarter_turns_;
};

/// Whether all material in some tiles of a stock, given by their first and last dexel, is one uniform block.
bool are_uniform(const Stock& stock, const DexelPlace& first, const DexelPlace& last) {
  const Tile& one = stock.tile({first.column / Tile::kSize, first.row / Tile::kSize});
  for (int row = first.row / Tile::kSize; row <= last.row / Tile::kSize; ++row)
    for (int column = first.column / Tile::kSize; column <= last.column / Tile::kSize; ++column) {
      const Tile& tile = stock.tile({column, row});
      if (!tile.is_uniform() || tile.floor() != one.floor() || tile.ceiling() != one.ceiling()) return false;
    }
  return true;
}

Tile tile_of_left(const LeftStock& left, const DexelGrid& grid) {
  const LeftStockPlace place(left);
  const Stock& stock = *left.stock;
  const auto nearest = [&](int column, int row) {
    const Vec2 at = (place.then({grid.x(column), grid.y(row)}) - stock.grid().first).cwiseProduct(stock.grid().per_mm);
    return DexelPlace{static_cast<int>(std::clamp(std::round(at.y()), 0.0, stock.grid().rows - 1.0)),
                      static_cast<int>(std::clamp(std::round(at.x()), 0.0, stock.grid().columns - 1.0))};
  };
  const DexelPlace one = nearest(0, 0);
  const DexelPlace other = nearest(grid.columns - 1, grid.rows - 1);
  if (are_uniform(stock, {std::min(one.row, other.row), std::min(one.column, other.column)},
                  {std::max(one.row, other.row), std::max(one.column, other.column)})) {
    const Tile& tile = stock.tile({one.column / Tile::kSize, one.row / Tile::kSize});
    if (tile.is_empty()) return {grid.columns, grid.rows, 0, 0};
    const DexelInterval interval = place.placed(DexelInterval{0, 0, tile.floor(), tile.ceiling()});
    return {grid.columns, grid.rows, interval.bottom, interval.top};
  }
  std::vector<DexelInterval> material;
  std::vector<DexelInterval> dexel;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const DexelPlace from = nearest(column, row);
      const Tile& tile = stock.tile({from.column / Tile::kSize, from.row / Tile::kSize});
      dexel.clear();
      for (const HeightInterval& z : tile.intervals(from.row % Tile::kSize, from.column % Tile::kSize))
        dexel.push_back(place.placed({row, column, static_cast<float>(z.bottom), static_cast<float>(z.top)}));
      if (left.is_turned_over) std::reverse(dexel.begin(), dexel.end());
      for (const DexelInterval& interval : dexel)
        if (interval.bottom < interval.top) material.push_back(interval);
    }
  return {grid.columns, grid.rows, material};
}

}  // namespace

DexelGrid DexelGrid::tile(int tile_column, int tile_row) const {
  const int column = tile_column * Tile::kSize;
  const int row = tile_row * Tile::kSize;
  return {.first = {x(column), y(row)},
          .spacing = spacing,
          .per_mm = per_mm,
          .columns = std::min(Tile::kSize, columns - column),
          .rows = std::min(Tile::kSize, rows - row)};
}

DexelGrid grid_over(const BoundingBox& bounds, double spacing) {
  const Vec3 size = bounds.sizes().cwiseMax(kMinSize);
  return grid_of(bounds, cells_across(size.x(), spacing), cells_across(size.y(), spacing));
}

DexelGrid grid_of(const BoundingBox& bounds, int columns, int rows) {
  DexelGrid grid;
  const Vec3 size = bounds.sizes().cwiseMax(kMinSize);
  grid.columns = columns;
  grid.rows = rows;
  grid.spacing = {size.x() / grid.columns, size.y() / grid.rows};
  grid.per_mm = grid.spacing.cwiseInverse();
  grid.first = bounds.min().head<2>() + grid.spacing / 2;
  return grid;
}

BoundingBox bounds_of(const Blank& blank) {
  if (const auto* left = std::get_if<LeftStock>(&blank)) return LeftStockPlace(*left).bounds();
  if (const auto* mesh = std::get_if<const solids::Mesh*>(&blank)) return (*mesh)->bounds();
  if (const auto* cylinder = std::get_if<solids::Cylinder>(&blank)) return cylinder->bounds();
  return std::get<solids::Cuboid>(blank).bounds();
}

BoundingBox bounds_of(const Blank& blank, const std::optional<Window>& window) {
  BoundingBox bounds = bounds_of(blank);
  if (!window) return bounds;
  bounds.min().head<2>() = bounds.min().head<2>().cwiseMax(window->min());
  bounds.max().head<2>() = bounds.max().head<2>().cwiseMin(window->max());
  return bounds;
}

DexelGrid grid_over(const Blank& blank, double spacing, const std::optional<Window>& window) {
  const auto* left = std::get_if<LeftStock>(&blank);
  if (!left || window) return grid_over(bounds_of(blank, window), spacing);
  // The sides of the earlier bounds: a shift may change their last digits, and so add a cell.
  DexelGrid grid = grid_over(left->stock->bounds(), spacing);
  if (LeftStockPlace(*left).is_turned_aside()) std::swap(grid.columns, grid.rows);
  return grid_of(bounds_of(blank), grid.columns, grid.rows);
}

Tile tile_of(const Blank& blank, const DexelGrid& grid) {
  if (const auto* left = std::get_if<LeftStock>(&blank)) return tile_of_left(*left, grid);
  if (const auto* mesh = std::get_if<const solids::Mesh*>(&blank)) return tile_of_mesh(**mesh, grid);
  if (const auto* cylinder = std::get_if<solids::Cylinder>(&blank)) return tile_of_cylinder(*cylinder, grid);
  return tile_of_box(std::get<solids::Cuboid>(blank), grid);
}

}  // namespace isocnc::stock
