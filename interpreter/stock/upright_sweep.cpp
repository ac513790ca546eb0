#include "interpreter/stock/upright_sweep.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "interpreter/stock/flat_line.h"
#include "interpreter/stock/slope_sweep.h"

namespace isocnc::stock {

using chords::LowerSurface;
using geometry::Vec2;
using geometry::Vec3;
using Kind = LowerSurface::Kind;

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
using Squares = std::array<double, Tile::kSize>;

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
  ISOCNC_VECTOR_CLONES static void fill(const std::vector<LowerSurface>& surfaces, double origin, const double* squares,
                                        int size, float* heights) {
    if (const LowerSurface& ball = surfaces.front();
        surfaces.size() == 1 && ball.kind == Kind::Round && ball.middle == 0 && ball.start == 0) {
      const double middle = ball.z + origin;
      const double square = ball.rounding * ball.rounding;
      for (int i = 0; i < size; ++i) {
        const double rest = square - squares[i];
        heights[i] = chords::float_above(middle - square_root(rest));
      }
      return;
    }
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
    const double* const from = lowest.data();
    for (int i = 0; i < size; ++i) heights[i] = chords::float_above(from[i] + origin);
  }

  /// In loops that become vectors.
  ISOCNC_VECTOR_CLONES static void fill(const LowerSurface& surface, const double* square, int size, double* heights) {
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
    } else {
      for (int i = 0; i < size; ++i) {
        const double r = std::sqrt(square[i]);
        const double out = (r > start ? r : start) - middle;
        const double rest = rounding - out * out;
        heights[i] = z - square_root(rest);
      }
    }
  }

  const RevolvedColumn& column_;
  HeightInterval origin_;
  DexelSink& sink_;
};

/// The squares of the distances of `size` dexels of a row from a line. `u` and `rise` lead from the start of the line
/// to the first of them, `step` to the next.
ISOCNC_VECTOR_CLONES void measure(const FlatLine& path, double u, double step, double rise, int size, double* squares) {
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

bool is_left(const Vec3& one, const Vec3& other) {
  for (int i = 0; i < 3; ++i)
    if (one[i] != other[i]) return one[i] < other[i];
  return true;
}

/// Where a level motion of a body surely finds nothing, since the one before it has ended where it starts: the dexels
/// to which no point of the motion is nearer than its start, if a point of the motion before is. These are as long as
/// they would be if they were taken, to the last bit.
class ClearedRow {
 public:
  ClearedRow(bool is_flat, const UprightLine& line, const UprightLine* before) : start_(line.from.head<2>()) {
    if (!before || before->to != line.from || before->from.z() != line.from.z() || line.to.z() != line.from.z()) return;
    direction_ = (line.to - line.from).head<2>();
    direction_before_ = (before->to - before->from).head<2>();
    const double length = direction_.norm();
    const double length_before = direction_before_.norm();
    if (!is_flat && !(length > 0 && length_before > kMargin)) return;
    direction_ /= length;
    direction_before_ /= length_before;
    is_known_ = true;
  }

  bool is_known() const { return is_known_; }
  /// The x in the row at y. Of a flat body, it is the chord near the start.
  HeightInterval of(double y) const {
    const double rise = y - start_.y();
    HeightInterval x{-kNever, kNever};
    clip_behind(direction_, rise, x);
    clip_behind(direction_before_, rise, x);
    return x.is_empty() ? HeightInterval() : HeightInterval{x.bottom + start_.x(), x.top + start_.x()};
  }

 private:
  /// Far more than rounding can move a point, mm.
  static constexpr double kMargin = 0.001;

  /// Leaves the x at which (x, rise) is behind the start by more than the margin.
  static void clip_behind(const Vec2& direction, double rise, HeightInterval& x) {
    const double along = rise * direction.y() + kMargin;
    if (std::abs(direction.x()) < 1e-6) {
      if (!(along + kMargin < 0)) x = {};
    } else if (direction.x() > 0) {
      x.clip({-kNever, -along / direction.x()});
    } else {
      x.clip({-along / direction.x(), kNever});
    }
  }

  Vec2 start_;
  Vec2 direction_ = Vec2::Zero();
  Vec2 direction_before_ = Vec2::Zero();
  bool is_known_ = false;
};

using RowGroup = Eigen::Array<float, kTogether, 1>;

bool are_at_most(float height, const float* values) { return Eigen::Map<const RowGroup>(values).maxCoeff() <= height; }

/// Tells of dexels, without a square root, that they surely end below a ball that moves along a level
/// line. In short moves most dexels do, since the moves before have cut them.
class BallTest {
 public:
  BallTest(const RevolvedColumn& column, const FlatLine& path, const HeightInterval& origin, double step) {
    const LowerSurface& lower = column.lower.front();
    is_usable_ = column.lower.size() == 1 && column.is_flat_above() && lower.kind == Kind::Round && lower.middle == 0 &&
                 lower.start == 0;
    x_ = static_cast<float>(path.direction.x());
    y_ = static_cast<float>(path.direction.y());
    length_ = static_cast<float>(path.length);
    middle_ = static_cast<float>(lower.z + origin.bottom);
    const double square = lower.rounding * lower.rounding;
    // The errors of floats: of places along the path, and of heights.
    const double error = 1e-6 * (path.length + 4 * column.radius + std::abs(middle_));
    square_ = static_cast<float>(square + 8 * column.radius * error + 1e-6 * square);
    step_ = static_cast<float>(step);
  }

  bool is_usable() const { return is_usable_; }
  /// Sets a number above 0 for each dexel that may end within the ball. `u` and `rise` as measure() has them. In a loop
  /// that becomes vectors.
  ISOCNC_VECTOR_CLONES void find(const float* tops, int size, double u, double rise, float* within) const {
    const float x = x_;
    const float y = y_;
    const float length = length_;
    const float middle = middle_;
    const float square = square_;
    const float step = step_;
    const auto first = static_cast<float>(u);
    const float along_first = static_cast<float>(rise) * y;
    const float aside_first = static_cast<float>(rise) * x;
    for (int i = 0; i < size; ++i) {
      const float at = first + static_cast<float>(i) * step;
      const float along = at * x + along_first;
      const float aside = at * y - aside_first;
      const float beyond = along - length + positive(length - positive(along));
      const float below = positive(middle - tops[i]);
      within[i] = square - aside * aside - beyond * beyond - below * below;
    }
  }

 private:
  float x_;  ///< Of the path's direction.
  float y_;
  float length_;
  float middle_;
  float square_;
  float step_;
  bool is_usable_;
};

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

void sweep(const RevolvedColumn& column, const UprightLine& line, const UprightLine* before, DexelSink& sink) {
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
  const ClearedRow cleared(is_flat, line, sink.cuts() ? before : nullptr);
  const auto lowest = static_cast<float>(origin.bottom + column.bottom);
  Squares squares;
  std::array<float, Tile::kSize> within;  // As BallTest has it.
  FlatLine::Rows rows;
  const int first_row = grid.first_row(std::min(from.y(), to.y()) - column.radius);
  const int last_row = grid.first_row(std::max(from.y(), to.y()) + column.radius);
  path.find(grid, first_row, last_row - first_row, rows);
  for (int row = first_row; row < last_row; ++row) {
    const double y = grid.y(row);
    const auto at = static_cast<std::size_t>(row - first_row);
    const HeightInterval x{rows.bottom[at], rows.top[at]};
    if (!(x.bottom < x.top)) continue;
    const double rise = y - path.start.y();
    const double start = grid.first.x() - path.start.x();
    const double step = grid.spacing.x();
    const auto take = [&](int from_column, int to_column) {
      measure(path, start + from_column * step, step, rise, to_column - from_column, squares.data());
      heights.take(row, from_column, to_column, squares.data());
    };
    const auto take_all = [&](int first, int last) {
      if (first >= last) return;
      if (is_flat) return sink.take_run(row, first, last, {origin.bottom + column.bottom, origin.top + column.top});
      const float* const tops = reaches_above ? sink.tops_to_cut(row, first) : nullptr;
      if (tops && ball.is_usable()) ball.find(tops, last - first, start + first * step, rise, within.data());
      int waiting = first;  // From here on, dexels are to be taken.
      for (int i = first; tops && i + kTogether <= last; i += kTogether) {
        const bool is_free =
            ball.is_usable() ? are_at_most(0, within.data() + (i - first)) : are_at_most(lowest, tops + (i - first));
        if (!is_free) continue;
        if (waiting < i) take(waiting, i);
        waiting = i + kTogether;
      }
      if (waiting < last) take(waiting, last);
    };
    const int first = grid.first_column(x.bottom);
    const int last = grid.first_column(x.top);
    if (first >= last) continue;
    HeightInterval done;
    if (cleared.is_known() && is_flat) {
      done = is_forward ? HeightInterval{rows.start_bottom[at], rows.start_top[at]}
                        : HeightInterval{rows.stop_bottom[at], rows.stop_top[at]};
    } else if (cleared.is_known()) {
      done = cleared.of(y);
    }
    if (done.is_empty()) {
      take_all(first, last);
    } else {
      take_all(first, std::min(last, grid.first_column(done.bottom)));
      take_all(std::max(first, grid.first_column(done.top)), last);
    }
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
