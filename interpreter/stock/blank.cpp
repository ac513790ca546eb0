#include "interpreter/stock/blank.h"

#include <algorithm>
#include <cmath>

#include "interpreter/chords/line_chord.h"

namespace isocnc::stock {

using geometry::Vec2;
using geometry::Vec3;

namespace {

constexpr int kMaxDexelsAcross = 1 << 17;

int cells_across(double size, double spacing) {
  const double cells = std::ceil(size / spacing * (1 - 1e-12));
  if (!(cells > 1)) return 1;
  return cells < kMaxDexelsAcross ? static_cast<int>(cells) : kMaxDexelsAcross;
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
void fill_between(std::vector<SurfaceCrossing>& crossings, std::vector<std::vector<HeightInterval>>& material) {
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
    auto& intervals = material[static_cast<std::size_t>(dexel)];
    if (static_cast<float>(bottom) < static_cast<float>(crossing.z)) intervals.push_back({bottom, crossing.z});
  }
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
  std::vector<std::vector<HeightInterval>> material(static_cast<std::size_t>(grid.columns) *
                                                    static_cast<std::size_t>(grid.rows));
  fill_between(crossings, material);
  return {grid.columns, grid.rows, material};
}

Tile tile_of_cylinder(const solids::Cylinder& cylinder, const DexelGrid& grid) {
  const chords::FrustumChord chord({0, cylinder.radius, cylinder.height, cylinder.radius}, cylinder.at);
  std::vector<std::vector<HeightInterval>> material;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const HeightInterval interval = chord.of(Vec2(grid.x(column), grid.y(row)));
      material.emplace_back();
      if (!interval.is_empty()) material.back().push_back(interval);
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

DexelGrid grid_over(const solids::BoundingBox& bounds, double spacing) {
  DexelGrid grid;
  const Vec3 size = bounds.sizes().cwiseMax(1e-9);
  grid.columns = cells_across(size.x(), spacing);
  grid.rows = cells_across(size.y(), spacing);
  grid.spacing = {size.x() / grid.columns, size.y() / grid.rows};
  grid.per_mm = grid.spacing.cwiseInverse();
  grid.first = bounds.min().head<2>() + grid.spacing / 2;
  return grid;
}

solids::BoundingBox bounds_of(const Blank& blank) {
  if (const auto* mesh = std::get_if<const solids::Mesh*>(&blank)) return (*mesh)->bounds();
  if (const auto* cylinder = std::get_if<solids::Cylinder>(&blank)) return cylinder->bounds();
  return std::get<solids::Cuboid>(blank).bounds();
}

Tile tile_of(const Blank& blank, const DexelGrid& grid) {
  if (const auto* mesh = std::get_if<const solids::Mesh*>(&blank)) return tile_of_mesh(**mesh, grid);
  if (const auto* cylinder = std::get_if<solids::Cylinder>(&blank)) return tile_of_cylinder(*cylinder, grid);
  const solids::Cuboid& box = std::get<solids::Cuboid>(blank);
  return {grid.columns, grid.rows, static_cast<float>(box.minimum.z()), static_cast<float>(box.maximum.z())};
}

}  // namespace isocnc::stock
