#pragma once

#include <array>
#include <optional>

#include "interpreter/kinematics/element.h"

namespace isocnc::motion {

/// The curve that replaces a corner on machines whose jerk is not limited. It leaves one element and joins the next
/// along their tangents, and is passed at a constant ds/dt. Between two lines it is a parabola, whose acceleration is
/// constant; at an arc it is a cubic, whose acceleration changes linearly from end to end.
struct Blend {
  kinematics::Path path;  ///< The curve; s runs from 0 to `length`.
  double length = 0;      ///< Range of s, mm or degrees: twice the length cut off from each element.
  double cap = 0;         ///< Maximum of (ds/dt)^2 by the axes and both feeds, mm^2/s^2.
};

/// How two elements meet.
enum class Junction : std::uint8_t {
  Stop,     ///< The machine stops: the elements share no space in which a blend could be computed.
  Smooth,   ///< The second element continues the first: no blend is needed.
  Rounded,  ///< A blend joins the elements.
};

struct Corner {
  Junction junction = Junction::Stop;
  Blend blend;  ///< The curve of a Junction::Rounded; unused otherwise.
  /// Derivatives of the joints on both lines of the tip where a blend of the tip meets them; absent in other corners.
  std::optional<kinematics::Derivatives> joints_before;
  std::optional<kinematics::Derivatives> joints_after;
};

/// Computes the corner between two consecutive elements. The blend stays within the machine's corner tolerance, and
/// cuts off at most a quarter of either element (a quarter from each end, so half remains).
Corner corner(const kinematics::Machine& machine, const kinematics::Element& before, const kinematics::Element& after);

/// The curve that replaces a corner on machines whose jerk is limited: three cubics of equal length. The second
/// derivative has no step within the curve, nor where it leaves one element and joins the next.
struct SmoothBlend {
  std::array<kinematics::Path, 3> paths;  ///< The three cubics; s of each runs from 0 to `length` / 3.
  double length = 0;  ///< Range of s of all three, mm or degrees: twice the length cut off from each element.
};

struct SmoothCorner {
  Junction junction = Junction::Stop;  ///< Junction::Smooth requires equal curvature as well as equal direction.
  SmoothBlend blend;                   ///< The curve of a Junction::Rounded; unused otherwise.
};

/// Computes the corner for machines whose jerk is limited. The speed may change within such a corner, so the blend may
/// cut off up to half of either element (half from each end, so nothing need remain).
SmoothCorner smooth_corner(const kinematics::Machine& machine, const kinematics::Element& before,
                           const kinematics::Element& after);

}  // namespace isocnc::motion
