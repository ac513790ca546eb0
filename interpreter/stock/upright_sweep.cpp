#include "interpreter/stock/upright_sweep.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace isocnc::stock {

using chords::LowerSurface;
using geometry::Vec2;
using geometry::Vec3;
using Kind = LowerSurface::Kind;

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
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

  void take(int row, int first, int last, const double* squares) {
    const int size = last - first;
    fill(column_.lower, origin_.bottom, squares, size, sink_.bottoms());
    if (column_.is_flat_above()) return sink_.take_row(row, first, last, origin_.top + column_.top);
    fill(column_.upper, -origin_.top, squares, size, sink_.tops());
    for (int i = 0; i < size; ++i) sink_.tops()[i] = -sink_.tops()[i];
    sink_.take_row(row, first, last);
  }

 private:
  static void fill(const std::vector<LowerSurface>& surfaces, double origin, const double* squares, int size,
                   float* heights) {
    std::array<double, Tile::kSize> lowest;
    if (surfaces.size() == 1) {  // It reaches as far as the column.
      fill(surfaces.front(), squares, size, lowest.data());
    } else {
      std::fill_n(lowest.data(), size, kNever);
      std::array<double, Tile::kSize> other;
      for (const LowerSurface& surface : surfaces) {
        fill(surface, squares, size, other.data());
        const double limit = surface.end * surface.end;
        double* const lowest_of = lowest.data();
        const double* const other_of = other.data();
        for (int i = 0; i < size; ++i)
          lowest_of[i] = squares[i] <= limit && other_of[i] < lowest_of[i] ? other_of[i] : lowest_of[i];
      }
    }
    constexpr double kUp = 6.0e-8;
    const double* const from = lowest.data();
    for (int i = 0; i < size; ++i) {
      const double height = from[i] + origin;
      heights[i] = static_cast<float>(height + std::abs(height) * kUp);
    }
  }

  /// In loops that become vectors.
  static void fill(const LowerSurface& surface, const double* square, int size, double* heights) {
    const double z = surface.z;
    const double start = surface.start;
    const double middle = surface.middle;
    const double slope = surface.slope;
    const double rounding = surface.rounding * surface.rounding;
    if (surface.kind == Kind::Flat) {
      std::fill_n(heights, size, z);
    } else if (surface.kind == Kind::Cone) {
      for (int i = 0; i < size; ++i) {
        const double r = std::sqrt(square[i]);
        heights[i] = z + slope * (r > start ? r - start : 0.0);
      }
    } else if (middle == 0 && start == 0) {
      for (int i = 0; i < size; ++i) {
        const double rest = rounding - square[i];
        heights[i] = z - std::sqrt(rest > 0 ? rest : 0.0);
      }
    } else {
      for (int i = 0; i < size; ++i) {
        const double r = std::sqrt(square[i]);
        const double out = (r > start ? r : start) - middle;
        const double rest = rounding - out * out;
        heights[i] = z - std::sqrt(rest > 0 ? rest : 0.0);
      }
    }
  }

  const RevolvedColumn& column_;
  HeightInterval origin_;
  DexelSink& sink_;
};

/// The path of a line in the plane, with the body's radius.
struct FlatLine {
  Vec2 start;
  Vec2 stop;
  Vec2 direction;  ///< Unit vector; any if the length is 0.
  double length;
  double radius;

  FlatLine(const Vec3& from, const Vec3& to, double body_radius)
      : start(from.head<2>()), stop(to.head<2>()), direction(1, 0), radius(body_radius) {
    const Vec2 along = stop - start;
    length = along.norm();
    if (length > 0) direction = along / length;
    has_sides_ = length > 0 && std::abs(direction.y()) >= 1e-12;  // Else both ends reach as far.
    if (!has_sides_) return;
    is_steep_ = std::abs(direction.x()) < 1e-12;
    shear_ = direction.x() / direction.y();
    half_width_ = radius / std::abs(direction.y());
    if (!is_steep_) lean_ = direction.y() / direction.x();
    if (!is_steep_) end_ = length / direction.x();
  }

  /// The x of all points at the height y that are nearer than the radius to the line: those near either end, and those
  /// beside it.
  HeightInterval row(double y) const {
    HeightInterval x;
    const double first = half_chord(radius, y - start.y());
    if (first >= 0) x.include({start.x() - first, start.x() + first});
    const double last = half_chord(radius, y - stop.y());
    if (last >= 0) x.include({stop.x() - last, stop.x() + last});
    if (has_sides_) x.include(beside(y - start.y()));
    return x;
  }

 private:
  /// |u d_y - rise d_x| <= radius and 0 <= u d_x + rise d_y <= length, for u = x - start.x.
  HeightInterval beside(double rise) const {
    const double middle = rise * shear_;
    HeightInterval u{middle - half_width_, middle + half_width_};
    if (is_steep_) {
      if (rise * direction.y() < 0 || rise * direction.y() > length) return {};
    } else {
      const double one = -rise * lean_;
      const double other = one + end_;
      u.clip({std::min(one, other), std::max(one, other)});
    }
    return u.bottom <= u.top ? HeightInterval{u.bottom + start.x(), u.top + start.x()} : HeightInterval();
  }

  bool has_sides_ = false;
  bool is_steep_ = false;
  double shear_ = 0;
  double half_width_ = 0;
  double lean_ = 0;
  double end_ = 0;
};

/// The squares of the distances of `size` dexels of a row from a line. `u` and `rise` lead from the start of the line
/// to the first of them, `step` to the next.
void measure(const FlatLine& path, double u, double step, double rise, int size, double* squares) {
  const Vec2 direction = path.direction;
  const double length = path.length;
  for (int i = 0; i < size; ++i) {
    const double at = u + i * step;
    const double along = at * direction.x() + rise * direction.y();
    const double aside = at * direction.y() - rise * direction.x();
    const double over = along - length;
    const double beyond = (along < 0 ? along : 0.0) + (over > 0 ? over : 0.0);
    squares[i] = aside * aside + beyond * beyond;
  }
}

/// Tells for eight dexels at once, without a square root, that they surely end below a ball that moves along a level
/// line. In short moves most dexels do, since the moves before have cut them.
class BallTest {
 public:
  static constexpr int kGroup = 8;

  BallTest(const RevolvedColumn& column, const FlatLine& path, const HeightInterval& origin, double step) {
    const LowerSurface& lower = column.lower.front();
    is_usable_ = column.lower.size() == 1 && column.is_flat_above() && lower.kind == Kind::Round && lower.middle == 0 &&
                 lower.start == 0;
    direction_ = path.direction.cast<float>();
    length_ = static_cast<float>(path.length);
    middle_ = static_cast<float>(lower.z + origin.bottom);
    const double square = lower.rounding * lower.rounding;
    // The errors of floats: of places along the path, and of heights.
    const double error = 1e-6 * (path.length + 4 * column.radius + std::abs(middle_));
    square_ = static_cast<float>(square + 8 * column.radius * error + 1e-6 * square);
    steps_ = static_cast<float>(step) * RowGroup::LinSpaced(0, kGroup - 1);
  }

  bool is_usable() const { return is_usable_; }
  /// As measure() has it.
  bool are_below(const float* tops, double u, double rise) const {
    const RowGroup at = steps_ + static_cast<float>(u);
    const auto y = static_cast<float>(rise);
    const RowGroup along = at * direction_.x() + y * direction_.y();
    const RowGroup aside = at * direction_.y() - y * direction_.x();
    const RowGroup beyond = along - along.max(0.0F).min(length_);
    const RowGroup below = (middle_ - Eigen::Map<const RowGroup>(tops)).max(0.0F);
    return !((square_ - aside.square() - beyond.square() - below.square()).maxCoeff() > 0);
  }

 private:
  using RowGroup = Eigen::Array<float, kGroup, 1>;
  Eigen::Vector2f direction_;
  float length_;
  float middle_;
  float square_;
  RowGroup steps_;
  bool is_usable_;
};

bool is_left(const Vec3& one, const Vec3& other) {
  for (int i = 0; i < 3; ++i)
    if (one[i] != other[i]) return one[i] < other[i];
  return true;
}

void sweep_slope(const RevolvedColumn& column, const FlatLine& path, double from_z, double to_z, DexelSink& sink) {
  const DexelGrid& grid = sink.grid();
  const double pitch = (to_z - from_z) / path.length;
  const double stop = path.stop.y();
  const int last_row = grid.first_row(std::max(path.start.y(), stop) + column.radius);
  for (int row = grid.first_row(std::min(path.start.y(), stop) - column.radius); row < last_row; ++row) {
    const double y = grid.y(row);
    const HeightInterval x = path.row(y);
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
  const FlatLine path(from, to, column.radius);
  if (path.length > 0 && from.z() != to.z()) return sweep_slope(column, path, from.z(), to.z(), sink);
  const DexelGrid& grid = sink.grid();
  const bool is_flat = column.is_flat_below() && column.is_flat_above();
  DistanceRow heights(column, origin, sink);
  const BallTest ball(column, path, origin, grid.spacing.x());
  const bool reaches_above = origin.top + column.top >= sink.ceiling();
  Squares squares{};
  const int last_row = grid.first_row(std::max(from.y(), to.y()) + column.radius);
  for (int row = grid.first_row(std::min(from.y(), to.y()) - column.radius); row < last_row; ++row) {
    const double y = grid.y(row);
    const HeightInterval x = path.row(y);
    const int first = grid.first_column(x.bottom);
    const int last = grid.first_column(x.top);
    if (first >= last) continue;
    if (is_flat) {
      sink.take_run(row, first, last, {origin.bottom + column.bottom, origin.top + column.top});
      continue;
    }
    const double rise = y - path.start.y();
    const double start = grid.first.x() - path.start.x();
    const double step = grid.spacing.x();
    const auto take = [&](int from, int to) {
      measure(path, start + from * step, step, rise, to - from, squares.data());
      heights.take(row, from, to, squares.data());
    };
    const float* const tops = reaches_above && ball.is_usable() ? sink.tops_to_cut(row, first) : nullptr;
    int done = first;
    for (int i = first; tops && i + BallTest::kGroup <= last; i += BallTest::kGroup, done = i)
      if (!ball.are_below(tops + (i - first), start + i * step, rise)) take(i, i + BallTest::kGroup);
    if (done < last) take(done, last);
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
      heights.take(row, first, last, squares.data());
    });
  }
}

}  // namespace isocnc::stock
