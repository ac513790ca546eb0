#include "interpreter/stock/upright_sweep.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace isocnc::stock {

using geometry::Vec2;
using geometry::Vec3;
using Kind = LowerSurface::Kind;

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr int kPack = 4;
using Pack = Eigen::Array<double, kPack, 1>;
using Squares = std::array<double, Tile::kSize>;

/// The half chord of a circle at a distance from its center; negative if there is none.
double half_chord(double radius, double aside) {
  const double square = radius * radius - aside * aside;
  return square >= 0 ? std::sqrt(square) : -1.0;
}

/// Sets the heights of a row from the squares of the distances between its dexels and the path, for a path at one
/// height or a plunge. Heights are rounded by a relative 2^-24 in the safe direction.
class DistanceRow {
 public:
  DistanceRow(const RevolvedColumn& column, const HeightInterval& origin, DexelSink& sink)
      : column_(column), origin_(origin), sink_(sink) {}

  void take(int row, int first, int last, const Squares& squares) {
    const int size = last - first;
    fill(column_.lower, origin_.bottom, squares, size, sink_.bottoms());
    if (column_.is_flat_above()) {
      std::fill_n(sink_.tops(), size, rounded_down(origin_.top + column_.top));
    } else {
      fill(column_.upper, -origin_.top, squares, size, sink_.tops());
      for (int i = 0; i < size; ++i) sink_.tops()[i] = -sink_.tops()[i];
    }
    sink_.take_row(row, first, last);
  }

 private:
  static void fill(const std::vector<LowerSurface>& surfaces, double origin, const Squares& squares, int size,
                   float* heights) {
    constexpr double kUp = 6.0e-8;
    for (int i = 0; i < size; i += kPack) {
      const Pack square = Eigen::Map<const Pack>(squares.data() + i);
      Pack lowest = Pack::Constant(kNever);
      for (const LowerSurface& surface : surfaces)
        lowest = (square <= surface.end * surface.end).select(lowest.min(heights_of(surface, square)), lowest);
      lowest += origin;
      lowest += lowest.abs() * kUp;
      const Eigen::Array<float, kPack, 1> rounded = lowest.cast<float>();
      for (int k = 0; k < std::min(kPack, size - i); ++k) heights[i + k] = rounded[k];
    }
  }

  static Pack heights_of(const LowerSurface& surface, const Pack& square) {
    if (surface.kind == Kind::Flat) return Pack::Constant(surface.z);
    if (surface.kind == Kind::Round && surface.middle == 0 && surface.start == 0)
      return surface.z - (surface.rounding * surface.rounding - square).max(0.0).sqrt();
    const Pack at = square.sqrt().max(surface.start);
    if (surface.kind == Kind::Cone) return surface.z + surface.slope * (at - surface.start);
    return surface.z - (surface.rounding * surface.rounding - (at - surface.middle).square()).max(0.0).sqrt();
  }

  const RevolvedColumn& column_;
  HeightInterval origin_;
  DexelSink& sink_;
};

/// The path of a line in the plane, from its end with the smaller x.
struct FlatLine {
  Vec2 start;
  Vec2 direction;  ///< Unit vector; any if the length is 0.
  double length;

  FlatLine(const Vec3& from, const Vec3& to) : start(from.head<2>()), direction(1, 0) {
    const Vec2 along = to.head<2>() - start;
    length = along.norm();
    if (length > 0) direction = along / length;
  }

  /// The x of all points at the height y that are nearer than `radius` to the line: those near either end, and those
  /// beside it.
  HeightInterval row(double y, double radius) const {
    HeightInterval x;
    const double first = half_chord(radius, y - start.y());
    if (first >= 0) x.include({start.x() - first, start.x() + first});
    const Vec2 stop = start + length * direction;
    const double last = half_chord(radius, y - stop.y());
    if (last >= 0) x.include({stop.x() - last, stop.x() + last});
    if (length > 0) x.include(beside(y, radius));
    return x;
  }

 private:
  HeightInterval beside(double y, double radius) const {
    const double rise = y - start.y();
    if (std::abs(direction.y()) < 1e-12) return {};  // The ends reach as far.
    // |u d_y - rise d_x| <= radius and 0 <= u d_x + rise d_y <= length, for u = x - start.x.
    const double middle = rise * direction.x() / direction.y();
    const double half = radius / std::abs(direction.y());
    HeightInterval u{middle - half, middle + half};
    if (std::abs(direction.x()) < 1e-12) {
      if (rise * direction.y() < 0 || rise * direction.y() > length) return {};
    } else {
      const double one = -rise * direction.y() / direction.x();
      const double other = (length - rise * direction.y()) / direction.x();
      u.clip({std::min(one, other), std::max(one, other)});
    }
    return u.bottom <= u.top ? HeightInterval{u.bottom + start.x(), u.top + start.x()} : HeightInterval();
  }
};

bool is_left(const Vec3& one, const Vec3& other) {
  for (int i = 0; i < 3; ++i)
    if (one[i] != other[i]) return one[i] < other[i];
  return true;
}

void sweep_slope(const RevolvedColumn& column, const FlatLine& path, double from_z, double to_z, DexelSink& sink) {
  const DexelGrid& grid = sink.grid();
  const double pitch = (to_z - from_z) / path.length;
  const double stop = path.start.y() + path.length * path.direction.y();
  const int last_row = grid.first_row(std::max(path.start.y(), stop) + column.radius);
  for (int row = grid.first_row(std::min(path.start.y(), stop) - column.radius); row < last_row; ++row) {
    const double y = grid.y(row);
    const HeightInterval x = path.row(y, column.radius);
    const int first = grid.first_column(x.bottom);
    const int last = std::max(first, grid.first_column(x.top));
    for (int i = first; i < last; ++i) {
      const Vec2 point = Vec2(grid.x(i), y) - path.start;
      const double foot = point.dot(path.direction);
      const double aside = std::abs(point.x() * path.direction.y() - point.y() * path.direction.x());
      const double base = from_z + pitch * foot;
      double bottom = kNever;
      for (const LowerSurface& surface : column.lower)
        bottom = std::min(bottom, surface.lowest(aside, pitch, -foot, path.length - foot));
      double top = kNever;
      for (const LowerSurface& surface : column.upper)
        top = std::min(top, surface.lowest(aside, -pitch, -foot, path.length - foot));
      sink.set(i - first, {base + bottom, base - top});
    }
    sink.take_row(row, first, last);
  }
}

/// The runs of a row that an arc covers, at most four.
class ArcRow {
 public:
  ArcRow(const LevelArc& arc, double radius, double y) {
    const double rise = y - arc.center.y();
    include_ring(arc, radius, rise);
    for (const Vec2& end : {arc.start, arc.end}) {
      const double half = half_chord(radius, rise - end.y());
      if (half >= 0) append({end.x() - half, end.x() + half});
    }
    std::sort(runs_.begin(), runs_.begin() + size_,
              [](const HeightInterval& left, const HeightInterval& right) { return left.bottom < right.bottom; });
  }

  /// Calls `use` with the columns of each run, without overlaps.
  template <class Use>
  void for_each(const LevelArc& arc, const DexelGrid& grid, Use&& use) const {
    int done = 0;
    for (int i = 0; i < size_; ++i) {
      const HeightInterval& run = runs_[static_cast<std::size_t>(i)];
      const int first = std::max(done, grid.first_column(run.bottom + arc.center.x()));
      const int last = grid.first_column(run.top + arc.center.x());
      if (first < last) use(first, last);
      done = std::max(done, last);
    }
  }

 private:
  /// Of the ring between two circles, the part in the sector: to the left of the start, to the right of the end.
  void include_ring(const LevelArc& arc, double radius, double rise) {
    const double outer = half_chord(arc.radius + radius, rise);
    if (outer < 0) return;
    HeightInterval sector{-kNever, kNever};
    clip_to_left(sector, arc.start, rise);
    clip_to_left(sector, -arc.end, rise);
    const double inner = arc.radius > radius ? half_chord(arc.radius - radius, rise) : -1.0;
    if (inner < 0) return append_within({-outer, outer}, sector);
    append_within({-outer, -inner}, sector);
    append_within({inner, outer}, sector);
  }
  /// To the left of a ray from the center: ray.x rise - ray.y x >= 0.
  static void clip_to_left(HeightInterval& x, const Vec2& ray, double rise) {
    if (ray.y() == 0) {
      if (ray.x() * rise < 0) x = {};
    } else if (ray.y() > 0) {
      x.clip({-kNever, ray.x() * rise / ray.y()});
    } else {
      x.clip({ray.x() * rise / ray.y(), kNever});
    }
  }
  void append_within(HeightInterval run, const HeightInterval& sector) {
    run.clip(sector);
    append(run);
  }
  void append(const HeightInterval& run) {
    if (!run.is_empty()) runs_[static_cast<std::size_t>(size_++)] = run;
  }

  std::array<HeightInterval, 4> runs_;
  int size_ = 0;
};

double cross(const Vec2& one, const Vec2& other) { return one.x() * other.y() - one.y() * other.x(); }

}  // namespace

void sweep(const RevolvedColumn& column, const UprightLine& line, DexelSink& sink) {
  const bool is_forward = is_left(line.from, line.to);
  const Vec3& from = is_forward ? line.from : line.to;
  const Vec3& to = is_forward ? line.to : line.from;
  const HeightInterval origin{std::min(from.z(), to.z()), std::max(from.z(), to.z())};
  if (!sink.has_material_in({origin.bottom + column.bottom, origin.top + column.top})) return;
  const FlatLine path(from, to);
  if (path.length > 0 && from.z() != to.z()) return sweep_slope(column, path, from.z(), to.z(), sink);
  const DexelGrid& grid = sink.grid();
  const bool is_flat = column.is_flat_below() && column.is_flat_above();
  DistanceRow heights(column, origin, sink);
  Squares squares{};
  const int last_row = grid.first_row(std::max(from.y(), to.y()) + column.radius);
  for (int row = grid.first_row(std::min(from.y(), to.y()) - column.radius); row < last_row; ++row) {
    const double y = grid.y(row);
    const HeightInterval x = path.row(y, column.radius);
    const int first = grid.first_column(x.bottom);
    const int last = grid.first_column(x.top);
    if (first >= last) continue;
    if (is_flat) {
      sink.take_run(row, first, last, {origin.bottom + column.bottom, origin.top + column.top});
      continue;
    }
    const double rise = y - path.start.y();
    for (int i = first; i < last; ++i) {
      const double u = grid.x(i) - path.start.x();
      const double along = u * path.direction.x() + rise * path.direction.y();
      const double aside = u * path.direction.y() - rise * path.direction.x();
      const double beyond = along - std::clamp(along, 0.0, path.length);
      squares[static_cast<std::size_t>(i - first)] = aside * aside + beyond * beyond;
    }
    heights.take(row, first, last, squares);
  }
}

void sweep(const RevolvedColumn& column, const LevelArc& arc, DexelSink& sink) {
  const HeightInterval z{arc.z + column.bottom, arc.z + column.top};
  if (!sink.has_material_in(z)) return;
  const DexelGrid& grid = sink.grid();
  const bool is_flat = column.is_flat_below() && column.is_flat_above();
  DistanceRow heights(column, {arc.z, arc.z}, sink);
  Squares squares{};
  const double reach = arc.radius + column.radius;
  const int last_row = grid.first_row(arc.center.y() + reach);
  for (int row = grid.first_row(arc.center.y() - reach); row < last_row; ++row) {
    const double y = grid.y(row);
    ArcRow(arc, column.radius, y).for_each(arc, grid, [&](int first, int last) {
      if (is_flat) return sink.take_run(row, first, last, z);
      for (int i = first; i < last; ++i) {
        const Vec2 point(grid.x(i) - arc.center.x(), y - arc.center.y());
        double square = std::min((point - arc.start).squaredNorm(), (point - arc.end).squaredNorm());
        if (cross(arc.start, point) >= 0 && cross(point, arc.end) >= 0) {
          const double aside = point.norm() - arc.radius;
          square = std::min(square, aside * aside);
        }
        squares[static_cast<std::size_t>(i - first)] = square;
      }
      heights.take(row, first, last, squares);
    });
  }
}

}  // namespace isocnc::stock
