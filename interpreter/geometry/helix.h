#pragma once

#include <array>

#include "interpreter/geometry/range.h"
#include "interpreter/geometry/vectors.h"

namespace isocnc::geometry {

/// An arc that may rise on its way, mm: center + cos(a) out + sin(a) side + rise a / sweep, for a from 0 to `sweep`.
struct Helix {
  Vec3 center;        ///< In the plane of the start.
  Vec3 out;           ///< From the center to the start.
  Vec3 side;          ///< As `out`, a quarter turn later.
  Vec3 rise;          ///< In all. It may lean over the plane of the circle.
  double sweep = 0;   ///< Radians, positive.
  double cosine = 1;  ///< Of the sweep.
  double sine = 0;

  double length() const;  ///< Where the rise does not lean.
  /// From where to where each coordinate goes.
  std::array<Range, 3> extents() const;
};

/// Through both ends even where they are not equally far from the center: what is missing is spread over the way, as
/// the rise is (I.3.4.3.b). `normal` is a unit vector; `sweep_deg` is positive counterclockwise about it, and not 0.
Helix helix(const Vec3& from, const Vec3& to, const Vec3& center, const Vec3& normal, double sweep_deg);

}  // namespace isocnc::geometry
