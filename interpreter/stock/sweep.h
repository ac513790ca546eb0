#pragma once

#include <cstdint>
#include <limits>
#include <variant>

#include "interpreter/geometry/helix.h"
#include "interpreter/solids/revolved_body.h"
#include "interpreter/stock/tile.h"

namespace isocnc::stock {

// Paths of a body, workpiece frame, mm: where its origin goes, and how its axis stands.

/// A straight line with the axis at rest.
struct StraightPath {
  solids::AxisPlacement from;
  geometry::Vec3 to = geometry::Vec3::Zero();
};

/// An arc or helix with the axis at rest.
struct HelixPath {
  geometry::Helix helix;
  geometry::Vec3 axis = geometry::Vec3(0, 0, 1);  ///< Unit vector.
};

/// A straight line of the origin while the axis turns evenly, the shorter way, by less than half a turn. Both
/// placements may have the same origin. A curved path is cut into such ones by the caller.
struct TurningPath {
  solids::AxisPlacement from;
  solids::AxisPlacement to;
};

using SweepPath = std::variant<StraightPath, HelixPath, TurningPath>;

enum class SweepPurpose : std::uint8_t {
  Cut,  ///< Removes material.
  Ask,  ///< Counts the material that is met, and leaves it.
  /// Says as exactly whether material is met, and less exactly how much: where the body is deep in it, every 8th dexel
  /// counts, and while the axis turns, the first place at which a piece of the body meets a tile.
  Find,
};

/// A body along a piece of path. Values that are not finite, or above solids::kMaxCoordinate, make a sweep that does
/// nothing.
struct Sweep {
  const solids::RevolvedBody* body = nullptr;  ///< Must outlive the call.
  SweepPath path;
  CutTag tag = 0;  ///< Below 0xFFFFFFFF.
  SweepPurpose purpose = SweepPurpose::Cut;
  /// How wide the rims are, at the sides and at the ends of what the body covers, that SweepOutcome::inside_depth
  /// leaves out, mm; at most half the radius. 0: nothing is left out.
  double side_rim = 0;
  double end_rim = 0;
  /// Along an axis that is tilted the depth follows from the vertical dexels, which at the sides of a ball or a disc
  /// say too much. Where it is more than this, mm, SweepOutcome::inside_depth is measured along the axis, from material
  /// to where the body ends. This takes time.
  double depth_limit = std::numeric_limits<double>::infinity();
  /// The body contains that of the sweep before, which asks or finds on the same path. Finds where that one does.
  bool contains_last = false;
};

/// What a sweep has removed, or met.
struct SweepOutcome {
  double volume = 0;  ///< mm^3
  /// Greatest length of material in one dexel, taken along the axis of the body, mm: for a vertical axis the depth of
  /// the cut, for another one its projection.
  double depth = 0;
  double length = 0;                              ///< Greatest length of material in one dexel, vertical as it is, mm.
  geometry::Vec3 point = geometry::Vec3::Zero();  ///< Lower end of that material; of equal ones, the first in order.

  /// Of cuts: the depth, and its point, without the rims. Where the axis turns at one place, nothing is left out. What
  /// a tilted ball or bull nose takes off a slope counts as a layer that is parallel to what it leaves.
  double inside_depth = 0;
  geometry::Vec3 inside_point = geometry::Vec3::Zero();

  /// Whether any material has been met or removed. A body that only touches the material does not meet it.
  bool meets() const { return volume > 0; }
};

}  // namespace isocnc::stock
