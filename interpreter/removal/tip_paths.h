#pragma once

#include <limits>
#include <vector>

#include "interpreter/kinematics/path.h"
#include "interpreter/stock/sweep.h"

namespace isocnc::removal {

/// A piece of the tip's path while the tool goes along a stretch of motion, in the workpiece's eyes: machine frame of
/// the program, mm.
struct TipPath {
  stock::SweepPath path;
  double from = 0;  ///< Path parameter at its start.
  double to = 0;    ///< Path parameter at its end.
  /// How far from the tip the points of the tool are that matter, mm.
  double reach = 0;
  /// By how much the tip may be beside its own path, mm, and by how much of that too high or too low.
  double stray = 0;
  double stray_in_height = 0;
  double stray_of_axis = 0;  ///< Radians.
};

/// Which points of a tool matter.
struct ToolReach {
  double distance = 0;                                   ///< Within that distance of the tip, mm,
  double top = std::numeric_limits<double>::infinity();  ///< and below that height, machine frame of the program, mm,
  double radius = 0;                                     ///< if they are within that distance of the axis, mm.
};

/// Whether B or C moves on a path, of a machine that has them.
bool turns_axis(const kinematics::Kinematics& kinematics, const kinematics::Path& path);

/// Whether a path is that of a rounded corner.
bool is_rounded_corner(const kinematics::Path& path);

/// Appends the path of the tip for path parameters from `from` to `to`. Lines, arcs and helices are exact while B and C
/// rest. Other paths are divided, so that no point of the tool that matters strays from its own path by more than
/// `tolerance` mm.
void append_tip_paths(const kinematics::Kinematics& kinematics, const kinematics::Path& path, double from, double to,
                      const ToolReach& reach, double tolerance, std::vector<TipPath>& pieces);

/// The same path for a point of the tool's axis `height` mm above the tip.
stock::SweepPath shifted_along_axis(const stock::SweepPath& path, double height);

/// The same path, moved by `shift`.
stock::SweepPath moved(stock::SweepPath path, const geometry::Vec3& shift);

/// The direction of the tool's axis at the start of a path.
geometry::Vec3 axis_of(const stock::SweepPath& path);

/// How the tool stands at the start of a path.
solids::AxisPlacement start_of(const stock::SweepPath& path);

/// Where a path ends.
geometry::Vec3 end_of(const stock::SweepPath& path);

/// How the tool stands with its tip at a position: X, Y, Z, B, C.
solids::AxisPlacement placement_of(const kinematics::Kinematics& kinematics, const kinematics::Coordinates& tip);

/// How the tool stands at a parameter of a path.
solids::AxisPlacement placement_on(const kinematics::Kinematics& kinematics, const kinematics::Path& path, double s);

/// Length of the path, mm.
double length_of(const stock::SweepPath& path);

/// The lowest coordinate of the path along a direction, mm.
double lowest_along(const stock::SweepPath& path, const geometry::Vec3& direction);

}  // namespace isocnc::removal
