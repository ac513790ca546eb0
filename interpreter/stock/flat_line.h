#pragma once

#include <array>
#include <cmath>

#include "interpreter/chords/height_interval.h"
#include "interpreter/chords/vector_loops.h"
#include "interpreter/geometry/vectors.h"
#include "interpreter/stock/grid.h"

namespace isocnc::stock {

using chords::positive;
using chords::square_root;

/// The half chord of a circle at a distance from its center; negative if there is none.
inline double half_chord(double radius, double aside) {
  const double square = radius * radius - aside * aside;
  return square >= 0 ? std::sqrt(square) : -1.0;
}

/// The path of a line in the plane, with the body's radius.
class FlatLine {
 public:
  geometry::Vec2 start;
  geometry::Vec2 stop;
  geometry::Vec2 direction;  ///< Unit vector; any if the length is 0.
  double length;
  double radius;

  FlatLine(const geometry::Vec3& from, const geometry::Vec3& to, double body_radius)
      : start(from.head<2>()), stop(to.head<2>()), direction(1, 0), radius(body_radius) {
    const geometry::Vec2 along = stop - start;
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

  /// Where some rows meet all points that are nearer than the radius to the line, and where those near either end.
  struct Rows {
    using Ends = std::array<double, Tile::kSize>;
    Ends bottom, top;              ///< Empty where the bottom is not below the top.
    Ends start_bottom, start_top;  ///< Near the start. NaN where there are none.
    Ends stop_bottom, stop_top;    ///< Near the stop.
  };

  /// In loops that become vectors.
  void find(const DexelGrid& grid, int first_row, int count, Rows& rows) const {
    chord(grid, first_row, count, start, rows.start_bottom.data(), rows.start_top.data());
    chord(grid, first_row, count, stop, rows.stop_bottom.data(), rows.stop_top.data());
    const auto at = [](auto& ends, int i) -> double& { return ends[static_cast<std::size_t>(i)]; };
    for (int i = 0; i < count; ++i) {
      // A comparison with NaN chooses the other one.
      const double bottom =
          at(rows.start_bottom, i) < at(rows.stop_bottom, i) ? at(rows.start_bottom, i) : at(rows.stop_bottom, i);
      const double top = at(rows.start_top, i) > at(rows.stop_top, i) ? at(rows.start_top, i) : at(rows.stop_top, i);
      at(rows.bottom, i) = bottom == bottom ? bottom : at(rows.start_bottom, i);
      at(rows.top, i) = top == top ? top : at(rows.start_top, i);
    }
    for (int i = 0; has_sides_ && i < count; ++i) {
      chords::HeightInterval x{at(rows.bottom, i), at(rows.top, i)};
      const chords::HeightInterval sides = beside(grid.y(first_row + i) - start.y());
      if (!(x.bottom <= x.top)) x = {};
      x.include(sides);
      at(rows.bottom, i) = x.bottom;
      at(rows.top, i) = x.top;
    }
  }

 private:
  void chord(const DexelGrid& grid, int first_row, int count, const geometry::Vec2& middle, double* bottoms,
             double* tops) const {
    const double square = radius * radius;
    const double first = grid.first.y();
    const double step = grid.spacing.y();
    const double x = middle.x();
    const double y = middle.y();
    for (int i = 0; i < count; ++i) {
      const double aside = first + (first_row + i) * step - y;
      const double half = std::sqrt(square - aside * aside);
      bottoms[i] = x - half;
      tops[i] = x + half;
    }
  }

  /// |u d_y - rise d_x| <= radius and 0 <= u d_x + rise d_y <= length, for u = x - start.x.
  chords::HeightInterval beside(double rise) const {
    const double middle = rise * shear_;
    chords::HeightInterval u{middle - half_width_, middle + half_width_};
    if (is_steep_) {
      if (rise * direction.y() < 0 || rise * direction.y() > length) return {};
    } else {
      const double one = -rise * lean_;
      const double other = one + end_;
      u.clip({std::min(one, other), std::max(one, other)});
    }
    return u.bottom <= u.top ? chords::HeightInterval{u.bottom + start.x(), u.top + start.x()}
                             : chords::HeightInterval();
  }

  bool has_sides_ = false;
  bool is_steep_ = false;
  double shear_ = 0;
  double half_width_ = 0;
  double lean_ = 0;
  double end_ = 0;
};

}  // namespace isocnc::stock
