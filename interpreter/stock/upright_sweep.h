#pragma once

#include "interpreter/chords/revolved_column.h"
#include "interpreter/geometry/vectors.h"
#include "interpreter/stock/dexel_sink.h"

/// Sweeps of bodies with a vertical axis, in closed form. z of the motion is that of the body's origin.
namespace isocnc::stock {

using chords::RevolvedColumn;

/// A straight motion in any direction. The one back sweeps the same to the last bit.
struct UprightLine {
  geometry::Vec3 from = geometry::Vec3::Zero();
  geometry::Vec3 to = geometry::Vec3::Zero();
};

/// A level arc, counterclockwise seen from above, of at most half a turn.
struct LevelArc {
  geometry::Vec2 center = geometry::Vec2::Zero();
  geometry::Vec2 start = geometry::Vec2::Zero();  ///< From the center.
  geometry::Vec2 end = geometry::Vec2::Zero();    ///< From the center.
  double radius = 0;
  double z = 0;
};

/// `before`, if any, is a motion of the same body that has cut these dexels already.
void sweep(const RevolvedColumn& column, const UprightLine& line, const UprightLine* before, DexelSink& sink);
void sweep(const RevolvedColumn& column, const LevelArc& arc, DexelSink& sink);

}  // namespace isocnc::stock
