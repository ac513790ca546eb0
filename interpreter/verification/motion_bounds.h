#pragma once

#include "interpreter/kinematics/path.h"

namespace isocnc::verification {

/// Upper bounds of speeds along a part of a path, per unit of the path parameter.
struct MotionBounds {
  double tip = 0;     ///< Of the tool tip relative to the workpiece, mm.
  double joints = 0;  ///< Of the linear joints together, mm.
  double turn = 0;    ///< Of the direction of the tool relative to the workpiece, radians.
  double swing = 0;   ///< Table: of the distance from the spindle nose to the rotary axes, mm; else 0.
};

/// Returns bounds that hold for path parameters from `from` to `to`. On lines they are exact.
MotionBounds motion_bounds(const kinematics::Kinematics& kinematics, const kinematics::Path& path, double from,
                           double to);

/// Returns an upper bound of n . x for the path's first three coordinates x, between two path parameters. It is the
/// maximum on lines, arcs and polynomials; on a helix it is above it by less than the rise along n.
double highest_along(const kinematics::Path& path, const geometry::Vec3& n, double from, double to);

}  // namespace isocnc::verification
