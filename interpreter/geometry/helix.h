#pragma once

#include <array>

#include "interpreter/geometry/range.h"
#include "interpreter/geometry/vectors.h"

namespace isocnc::geometry {

/// An arc or helix, mm: center + cos(a) out + sin(a) side + rise a / sweep, for a from 0 to `sweep`.
struct Helix {
  Vec3 center;        ///< In the plane of the start.
  Vec3 out;           ///< From the center to the start.
  Vec3 side;          ///< From the center to the point a quarter turn after the start.
  Vec3 rise;          ///< Total rise; may be oblique to the plane of the circle.
  double sweep = 0;   ///< Radians, positive.
  double cosine = 1;  ///< Cosine of the sweep.
  double sine = 0;    ///< Sine of the sweep.

  double length() const;  ///< Valid only where the rise is not oblique.
  /// The range of each coordinate.
  std::array<Range, 3> extents() const;
};

/// The helix through both ends. A difference of their distances from the center is spread evenly over the path, like
/// the rise (I.3.4.3.b). `normal` is a unit vector; `sweep_deg` is positive counterclockwise about it, and not 0.
Helix helix(const Vec3& from, const Vec3& to, const Vec3& center, const Vec3& normal, double sweep_deg);

}  // namespace isocnc::geometry
