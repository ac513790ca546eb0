#include "interpreter/stock/surface.h"

#include <algorithm>
#include <array>
#include <span>

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

/// Every face has a corner wherever another face has one on its border, so that no edge is left without a partner.
class SurfaceBuilder {
 public:
  explicit SurfaceBuilder(const Stock& stock) : grid_(stock.grid()) {
    const auto size = static_cast<std::size_t>(grid_.columns) * static_cast<std::size_t>(grid_.rows);
    dexels_.resize(size);
    for (int row = 0; row < grid_.rows; ++row)
      for (int column = 0; column < grid_.columns; ++column)
        dexels_[number_of(row, column)] =
            stock.tile({column / Tile::kSize, row / Tile::kSize}).intervals(row % Tile::kSize, column % Tile::kSize);
  }

  std::vector<Triangle> build() {
    for (int row = 0; row < grid_.rows; row += Tile::kSize)
      for (int column = 0; column < grid_.columns; column += Tile::kSize) append_levels(row, column, Tile::kSize);
    for (int row = 0; row <= grid_.rows; ++row)
      for (int column = 0; column <= grid_.columns; ++column) {
        append_walls(row, column, row, column - 1, {row, column}, {row + 1, column});
        append_walls(row - 1, column, row, column, {row, column}, {row, column + 1});
      }
    return std::move(triangles_);
  }

 private:
  struct GridCorner {
    int row;
    int column;
  };

  std::size_t number_of(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(grid_.columns) + static_cast<std::size_t>(column);
  }
  const Intervals& dexel(int row, int column) const {
    static const Intervals kNone;
    if (row < 0 || row >= grid_.rows || column < 0 || column >= grid_.columns) return kNone;
    return dexels_[number_of(row, column)];
  }
  Vec3 point(const GridCorner& corner, double z) const {
    return {grid_.x(0) + (corner.column - 0.5) * grid_.spacing.x(), grid_.y(0) + (corner.row - 0.5) * grid_.spacing.y(),
            z};
  }

  /// The upper and lower faces of a square of dexels: together if all of them are the same.
  void append_levels(int row, int column, int size) {
    if (row >= grid_.rows || column >= grid_.columns) return;
    const int last_row = std::min(row + size, grid_.rows);
    const int last_column = std::min(column + size, grid_.columns);
    const Intervals& first = dexel(row, column);
    for (int i = row; i < last_row; ++i)
      for (int k = column; k < last_column; ++k) {
        if (are_same(dexel(i, k), first)) continue;
        const int half = size / 2;
        for (const int down : {0, half})
          for (const int right : {0, half}) append_levels(row + down, column + right, half);
        return;
      }
    if (first.empty()) return;
    std::vector<GridCorner> border;
    for (int k = column; k < last_column; ++k) border.push_back({row, k});
    for (int i = row; i < last_row; ++i) border.push_back({i, last_column});
    for (int k = last_column; k > column; --k) border.push_back({last_row, k});
    for (int i = last_row; i > row; --i) border.push_back({i, column});
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

  const DexelGrid& grid_;
  std::vector<Intervals> dexels_;
  std::vector<Triangle> triangles_;
};

}  // namespace

std::vector<Triangle> surface_of(const Stock& stock) { return SurfaceBuilder(stock).build(); }

}  // namespace isocnc::stock
