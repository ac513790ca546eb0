#include "interpreter/stock/slope_sweep.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

namespace isocnc::stock {

using chords::LowerSurface;

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// A slanted line, seen along its direction in the plane.
struct Slope {
  double pitch;   ///< Growth of z along the line.
  double length;  ///< In the plane.
};

/// The lowest point of a surface over each of some dexels while it moves along a slope, as LowerSurface::lowest has it,
/// in loops that become vectors. A dexel has its foot on the line, as a length from the start, and the square of its
/// distance from the line.
class SlopeRow {
 public:
  SlopeRow(const LowerSurface& surface, const Slope& slope) : surface_(surface), slope_(slope) {}

  /// Lowers `heights`, which are relative to the start of the line.
  void lower(const double* feet, const double* squares, int size, double* heights) const {
    const LowerSurface surface = surface_;
    const double steep = std::abs(slope_.pitch);
    const double start = surface.start;
    const double rounding = surface.rounding * surface.rounding;
    const double end = surface.end * surface.end;
    const auto inner = [=](double square) { return square_root(start * start - square); };
    const auto to_the_rim = [](double) { return kInfinite; };
    switch (surface.kind) {
      case LowerSurface::Kind::Flat:
        return lower(feet, squares, size, heights, to_the_rim, [=](double) { return surface.z; });
      case LowerSurface::Kind::Cone: {
        const auto height = [=](double square) {
          const double r = std::sqrt(square);
          return surface.z + surface.slope * (r > start ? r - start : 0.0);
        };
        if (!(surface.slope > steep)) return lower(feet, squares, size, heights, to_the_rim, height);
        const double share = steep / std::sqrt(surface.slope * surface.slope - steep * steep);
        return lower(
            feet, squares, size, heights,
            [=](double square) {
              const double lowest = share * std::sqrt(square);
              const double least = inner(square);
              return lowest > least ? lowest : least;
            },
            height);
      }
      case LowerSurface::Kind::Round:
        break;
    }
    const double middle = surface.middle;
    const auto height = [=](double square) {
      const double r = std::sqrt(square);
      const double out = (r > start ? r : start) - middle;
      return surface.z - square_root(rounding - out * out);
    };
    if (middle == 0) {
      const double share = steep / std::sqrt(1 + steep * steep);
      return lower(
          feet, squares, size, heights,
          [=](double square) {
            const double lowest = share * square_root(rounding - square);
            const double least = inner(square);
            return lowest > least ? lowest : least;
          },
          height);
    }
    // Where the slope of the surface along the line equals the pitch, by halving. Any place gives a height of the body,
    // and near the minimum an error hardly matters.
    lower(
        feet, squares, size, heights,
        [=](double square) {
          double low = inner(square);
          double high = square_root(end - square);
          for (int i = 0; i < kHalvings; ++i) {
            const double v = (low + high) / 2;
            const double r = std::sqrt(square + v * v);
            const double out = (r > start ? r : start) - middle;
            const bool rises = out * v < steep * r * square_root(rounding - out * out);
            low = rises ? v : low;
            high = rises ? high : v;
          }
          return (low + high) / 2;
        },
        height);
  }

 private:
  static constexpr int kHalvings = 16;

  /// `distance`: how far from its foot, against the rise, a dexel is lowest. `height`: that of the surface at the root
  /// of a square. Both are of floating point alone, without branches.
  template <class Distance, class Height>
  void lower(const double* feet, const double* squares, int size, double* heights, Distance&& distance,
             Height&& height) const {
    const double end = surface_.end * surface_.end;
    const double against = slope_.pitch > 0 ? -1.0 : 1.0;
    const double pitch = slope_.pitch;
    const double length = slope_.length;
    for (int i = 0; i < size; ++i) {
      const double foot = feet[i];
      const double square = squares[i];
      const double half = square_root(end - square);
      const double first = -foot > -half ? -foot : -half;
      const double last = length - foot < half ? length - foot : half;
      double v = against * distance(square);
      v = v > first ? v : first;
      v = v < last ? v : last;
      const double z = height(square + v * v) + pitch * (foot + v);
      const bool is_reached = (square <= end) & (first <= last);
      heights[i] = (is_reached & (z < heights[i])) ? z : heights[i];
    }
  }

  const LowerSurface& surface_;
  Slope slope_;
};

}  // namespace

void sweep_slope(const RevolvedColumn& column, const FlatLine& path, double from_z, double to_z, DexelSink& sink) {
  const DexelGrid& grid = sink.grid();
  const Slope slope{(to_z - from_z) / path.length, path.length};
  const Slope upside_down{-slope.pitch, path.length};
  const double lowest = std::min(from_z, to_z);
  const bool reaches_above = column.is_flat_above() && lowest + column.top >= sink.ceiling();
  const auto bottom = static_cast<float>(lowest + column.bottom);
  using Row = std::array<double, Tile::kSize>;
  Row feet, squares, heights;
  const auto take = [&](int row, int first, int last) {
    const geometry::Vec2 direction = path.direction;
    const double rise = grid.y(row) - path.start.y();
    const double u = grid.x(first) - path.start.x();
    const double step = grid.spacing.x();
    const int size = last - first;
    for (int i = 0; i < size; ++i) {
      const double at = u + i * step;
      const double aside = at * direction.y() - rise * direction.x();
      feet[static_cast<std::size_t>(i)] = at * direction.x() + rise * direction.y();
      squares[static_cast<std::size_t>(i)] = aside * aside;
    }
    std::fill_n(heights.data(), size, kInfinite);
    for (const LowerSurface& surface : column.lower)
      SlopeRow(surface, slope).lower(feet.data(), squares.data(), size, heights.data());
    constexpr double kUp = 6.0e-8;  // Rounds to a float that is not lower.
    float* const bottoms = sink.bottoms();
    for (int i = 0; i < size; ++i) {
      const double z = from_z + heights[static_cast<std::size_t>(i)];
      bottoms[i] = static_cast<float>(z + std::abs(z) * kUp);
    }
    if (reaches_above) return sink.take_row(row, first, last, lowest + column.top);
    std::fill_n(heights.data(), size, kInfinite);
    for (const LowerSurface& surface : column.upper)
      SlopeRow(surface, upside_down).lower(feet.data(), squares.data(), size, heights.data());
    float* const tops = sink.tops();
    for (int i = 0; i < size; ++i) {
      const double z = from_z - heights[static_cast<std::size_t>(i)];
      tops[i] = static_cast<float>(z - std::abs(z) * kUp);
    }
    sink.take_row(row, first, last);
  };
  const double stop = path.stop.y();
  FlatLine::Rows rows;
  const int first_row = grid.first_row(std::min(path.start.y(), stop) - column.radius);
  const int last_row = grid.first_row(std::max(path.start.y(), stop) + column.radius);
  path.find(grid, first_row, last_row - first_row, rows);
  for (int row = first_row; row < last_row; ++row) {
    const HeightInterval x{rows.bottom[static_cast<std::size_t>(row - first_row)],
                           rows.top[static_cast<std::size_t>(row - first_row)]};
    if (!(x.bottom < x.top)) continue;
    const int first = grid.first_column(x.bottom);
    const int last = grid.first_column(x.top);
    if (first >= last) continue;
    // Where the dexels end below the whole motion, nothing need be computed.
    const float* const tops = reaches_above ? sink.tops_to_cut(row, first) : nullptr;
    int from = first;
    for (int i = first; tops && i < last; i += kTogether) {
      const int size = std::min(kTogether, last - i);
      const float* const group = tops + (i - first);
      if (*std::max_element(group, group + size) > bottom) continue;
      if (from < i) take(row, from, i);
      from = i + size;
    }
    if (from < last) take(row, from, last);
  }
}

}  // namespace isocnc::stock
