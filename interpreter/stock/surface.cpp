#include "interpreter/stock/surface.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

namespace isocnc::stock {

using geometry::Vec3;
using solids::Triangle;

namespace {

using Intervals = std::vector<HeightInterval>;

bool are_same(const Intervals& one, const Intervals& other) {
  return std::equal(one.begin(), one.end(), other.begin(), other.end(),
                    [](const HeightInterval& left, const HeightInterval& right) {
                      return left.bottom == right.bottom && left.top == right.top;
                    });
}

/// What one dexel has and another has not.
Intervals without(const Intervals& one, const Intervals& other) {
  Intervals rest;
  for (HeightInterval piece : one) {
    for (const HeightInterval& cut : other) {
      if (cut.top <= piece.bottom || cut.bottom >= piece.top) continue;
      if (cut.bottom > piece.bottom) rest.push_back({piece.bottom, cut.bottom});
      piece.bottom = cut.top;
    }
    if (!piece.is_empty()) rest.push_back(piece);
  }
  return rest;
}

/// The dexels of one row of tiles, and the squares of dexels that are all the same.
class TileRow {
 public:
  TileRow(const Stock& stock, int tile_row) : columns_(stock.grid().columns), first_row_(tile_row * Tile::kSize) {
    rows_ = std::min(Tile::kSize, stock.grid().rows - first_row_);
    const auto size = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
    dexels_.resize(size);
    squares_.assign(size, 0);
    for (int column = 0; column < columns_; column += Tile::kSize) {
      const Tile& tile = stock.tile({column / Tile::kSize, tile_row});
      for (int row = 0; row < rows_; ++row)
        tile.for_each_interval(row, [&](int k, float bottom, float top) {
          dexels_[number_of(first_row_ + row, column + k)].push_back({bottom, top});
        });
      divide(first_row_, column, Tile::kSize);
    }
  }

  int first_row() const { return first_row_; }
  int rows() const { return rows_; }
  const Intervals& dexel(int row, int column) const { return dexels_[number_of(row, column)]; }
  /// The side of the square that a dexel is in, in dexels. Squares start at multiples of it.
  int square(int row, int column) const { return squares_[number_of(row, column)]; }

 private:
  std::size_t number_of(int row, int column) const {
    return static_cast<std::size_t>(row - first_row_) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }

  void divide(int row, int column, int size) {
    const int last_row = std::min(row + size, first_row_ + rows_);
    const int last_column = std::min(column + size, columns_);
    if (row >= last_row || column >= last_column) return;
    const Intervals& first = dexel(row, column);
    for (int i = row; i < last_row; ++i)
      for (int k = column; k < last_column; ++k) {
        if (are_same(dexel(i, k), first)) continue;
        const int half = size / 2;
        for (const int down : {0, half})
          for (const int right : {0, half}) divide(row + down, column + right, half);
        return;
      }
    for (int i = row; i < last_row; ++i)
      std::fill_n(squares_.begin() + static_cast<std::ptrdiff_t>(number_of(i, column)), last_column - column,
                  static_cast<std::uint8_t>(size));
  }

  int columns_;
  int first_row_;
  int rows_;
  std::vector<Intervals> dexels_;
  std::vector<std::uint8_t> squares_;
};

/// Every face has a corner wherever another face has one on its border, so that no edge is left without a partner. Goes
/// through the stock a row of tiles at a time, and knows the one before and the one after.
class SurfaceBuilder {
 public:
  explicit SurfaceBuilder(const Stock& stock) : stock_(stock), grid_(stock.grid()) {}

  std::vector<Triangle> build() {
    for (int tile_row = 0; tile_row < grid_.tile_rows(); ++tile_row) {
      for (int i = std::max(0, tile_row - 1); i <= std::min(tile_row + 1, grid_.tile_rows() - 1); ++i) load(i);
      const int first = tile_row * Tile::kSize;
      const int last = std::min(first + Tile::kSize, grid_.rows);
      for (int row = first; row < last; ++row)
        for (int column = 0; column < grid_.columns;) {
          const int size = square(row, column);
          if (row % size == 0) append_levels(row, column, size);
          column += size;
        }
      for (int row = first; row < (last < grid_.rows ? last : last + 1); ++row)
        for (int column = 0; column <= grid_.columns; ++column) {
          append_walls(row, column, row, column - 1, {row, column}, {row + 1, column});
          append_walls(row - 1, column, row, column, {row, column}, {row, column + 1});
        }
    }
    return std::move(triangles_);
  }

 private:
  struct GridCorner {
    int row;
    int column;
  };

  void load(int tile_row) {
    auto& place = tile_rows_[static_cast<std::size_t>(tile_row % 3)];
    if (!place || place->first_row() != tile_row * Tile::kSize) place.emplace(stock_, tile_row);
  }
  const TileRow& tile_row_of(int row) const { return *tile_rows_[static_cast<std::size_t>(row / Tile::kSize % 3)]; }
  bool is_outside(int row, int column) const {
    return row < 0 || row >= grid_.rows || column < 0 || column >= grid_.columns;
  }
  const Intervals& dexel(int row, int column) const {
    static const Intervals kNone;
    return is_outside(row, column) ? kNone : tile_row_of(row).dexel(row, column);
  }
  int square(int row, int column) const { return tile_row_of(row).square(row, column); }
  Vec3 point(const GridCorner& corner, double z) const {
    return {grid_.x(0) + (corner.column - 0.5) * grid_.spacing.x(), grid_.y(0) + (corner.row - 0.5) * grid_.spacing.y(),
            z};
  }

  /// Whether faces have a corner here: where a wall ends, or a square has one of its corners.
  bool has_corner(const GridCorner& corner) const {
    const Intervals& first = dexel(corner.row, corner.column);
    for (const int row : {corner.row - 1, corner.row})
      for (const int column : {corner.column - 1, corner.column}) {
        if (!are_same(dexel(row, column), first)) return true;
        if (is_outside(row, column)) continue;
        const int size = square(row, column);
        const int square_row = row / size * size;
        const int square_column = column / size * size;
        const int last_row = std::min(square_row + size, grid_.rows);
        const int last_column = std::min(square_column + size, grid_.columns);
        if ((corner.row == square_row || corner.row == last_row) &&
            (corner.column == square_column || corner.column == last_column))
          return true;
      }
    return false;
  }

  /// The upper and lower faces of a square of dexels that are all the same.
  void append_levels(int row, int column, int size) {
    const Intervals& first = dexel(row, column);
    if (first.empty()) return;
    const int last_row = std::min(row + size, grid_.rows);
    const int last_column = std::min(column + size, grid_.columns);
    std::vector<GridCorner> border;
    for (int k = column; k < last_column; ++k) border.push_back({row, k});
    for (int i = row; i < last_row; ++i) border.push_back({i, last_column});
    for (int k = last_column; k > column; --k) border.push_back({last_row, k});
    for (int i = last_row; i > row; --i) border.push_back({i, column});
    border.erase(
        std::remove_if(border.begin(), border.end(), [&](const GridCorner& corner) { return !has_corner(corner); }),
        border.end());
    for (const HeightInterval& interval : first)
      for (const bool is_top : {false, true}) {
        std::vector<Vec3> corners;
        for (const GridCorner& corner : border)
          corners.push_back(point(corner, is_top ? interval.top : interval.bottom));
        if (!is_top) std::reverse(corners.begin(), corners.end());
        append_polygon(corners);
      }
  }

  /// The walls between two dexels. From `start` to `end`, `left` is on the left.
  void append_walls(int left_row, int left_column, int right_row, int right_column, const GridCorner& start,
                    const GridCorner& end) {
    const Intervals& left = dexel(left_row, left_column);
    const Intervals& right = dexel(right_row, right_column);
    if (are_same(left, right)) return;
    const std::vector<double> of_start = ends_at(start);
    const std::vector<double> of_end = ends_at(end);
    for (const HeightInterval& wall : without(left, right)) append_wall(wall, end, of_end, start, of_start);
    for (const HeightInterval& wall : without(right, left)) append_wall(wall, start, of_start, end, of_end);
  }

  /// A wall that is seen from the front with `from` on the left.
  void append_wall(const HeightInterval& wall, const GridCorner& from, const std::vector<double>& of_from,
                   const GridCorner& to, const std::vector<double>& of_to) {
    std::vector<Vec3> corners;
    corners.push_back(point(from, wall.bottom));
    for (const double z : of_to)
      if (z >= wall.bottom && z <= wall.top) corners.push_back(point(to, z));
    corners.push_back(point(from, wall.top));
    for (auto z = of_from.rbegin(); z != of_from.rend(); ++z)
      if (*z > wall.bottom && *z < wall.top) corners.push_back(point(from, *z));
    append_polygon(corners);
  }

  /// The heights at which intervals of the four dexels around a corner end.
  std::vector<double> ends_at(const GridCorner& corner) const {
    std::vector<double> ends;
    for (const int row : {corner.row - 1, corner.row})
      for (const int column : {corner.column - 1, corner.column})
        for (const HeightInterval& interval : dexel(row, column)) {
          ends.push_back(interval.bottom);
          ends.push_back(interval.top);
        }
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    return ends;
  }

  /// A convex polygon, counterclockwise seen from outside. Several corners may lie on one side.
  void append_polygon(std::span<const Vec3> corners) {
    if (corners.size() == 4) {
      triangles_.push_back({{corners[0], corners[1], corners[2]}});
      triangles_.push_back({{corners[0], corners[2], corners[3]}});
      return;
    }
    Vec3 middle = Vec3::Zero();
    for (const Vec3& corner : corners) middle += corner;
    middle /= static_cast<double>(corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i)
      triangles_.push_back({{middle, corners[i], corners[(i + 1) % corners.size()]}});
  }

  const Stock& stock_;
  const DexelGrid& grid_;
  std::array<std::optional<TileRow>, 3> tile_rows_;  ///< By the number of the row, modulo 3.
  std::vector<Triangle> triangles_;
};

}  // namespace

std::vector<Triangle> surface_of(const Stock& stock) { return SurfaceBuilder(stock).build(); }

}  // namespace isocnc::stock
