#pragma once

#include <cstdint>
#include <vector>

#include "interpreter/chords/height_interval.h"
#include "interpreter/solids/revolved_body.h"

namespace isocnc::chords {

/// A piece of the lower surface of a body of revolution with a vertical axis: its height above the origin of the axis,
/// which never falls with the distance r from the axis, mm. Within `start` it is that at `start`; at more than `end`
/// there is no surface.
struct LowerSurface {
  enum class Kind : std::uint8_t {
    Flat,   ///< z
    Cone,   ///< z + slope (r - start)
    Round,  ///< z - sqrt(rounding^2 - (r - middle)^2), a ball or the rounded edge of a bull nose
  };

  Kind kind = Kind::Flat;
  double z = 0;
  double start = 0;
  double end = 0;
  double slope = 0;
  double middle = 0;    ///< r of the center of the rounding; not above `start`.
  double rounding = 0;  ///< Radius of the rounding.

  /// The height at r, which is at most `end`.
  double height(double r) const;
  /// The minimum of height(r) + pitch * v with r = hypot(aside, v) for v in [first, last]; infinite where r is above
  /// `end`. This is the height over a point that an axis passes at the distance `aside` while it rises by `pitch`.
  double lowest(double aside, double pitch, double first, double last) const;
};

/// A part of a body of revolution that each line parallel to the axis meets in one interval or not at all: its radius
/// grows, then shrinks. A cutter is one such part, a T slot cutter with its shank two.
struct RevolvedColumn {
  std::vector<LowerSurface> lower;  ///< The lowest of them counts.
  std::vector<LowerSurface> upper;  ///< The same of the body upside down.
  double radius = 0;                ///< Largest distance from the axis, mm.
  double bottom = 0;                ///< Smallest height, mm.
  double top = 0;                   ///< Largest height, mm.

  bool is_flat_below() const { return is_flat(lower); }
  bool is_flat_above() const { return is_flat(upper); }

 private:
  bool is_flat(const std::vector<LowerSurface>& surfaces) const {
    return surfaces.size() == 1 && surfaces.front().kind == LowerSurface::Kind::Flat && surfaces.front().end >= radius;
  }
};

/// The columns of a body, together all of it. `upside_down`: its axis points down. `shrunk_by`: its radii are smaller
/// by this, mm, so that a body does not meet a wall that it touches.
std::vector<RevolvedColumn> columns_of(const solids::RevolvedBody& body, bool upside_down, double shrunk_by);

/// A piece whose radii are smaller by this, mm, but not negative.
solids::BodyPiece shrunk(const solids::BodyPiece& piece, double by);

}  // namespace isocnc::chords
