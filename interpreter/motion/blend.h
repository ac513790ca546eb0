#pragma once

#include <array>

#include "interpreter/motion/element.h"

namespace isocnc::motion {

/// A corner rounded: leaves one element along its tangent and joins the next along the other's, at a constant rate of
/// the parameter, so that the acceleration runs from one bound to the other in proportion (on two lines it is constant,
/// and the curve a parabola).
struct Blend {
  Path path;          ///< s from 0 to `length`.
  double length = 0;  ///< Twice what is cut from each side.
  double cap = 0;     ///< Most square of ds/dt, by the axes and both feeds.
};

enum class Junction : std::uint8_t {
  Stop,    ///< The two have no common space to be rounded in.
  Smooth,  ///< They go on in the same direction.
  Rounded,
};

struct Corner {
  Junction junction = Junction::Stop;
  Blend blend;  ///< Of Junction::Rounded.
};

/// The corner between two elements where one ends and the other begins, within the machine's corner tolerance, and
/// with no more than half of each cut off, a quarter from each end.
Corner corner(const Machine& machine, const Element& before, const Element& after);

/// A corner rounded so that the second derivative has no steps: within the curve, and where it leaves the one element
/// and joins the other. Three cubics of equal length.
struct SmoothBlend {
  std::array<Path, 3> paths;  ///< s of each from 0 to a third of `length`.
  double length = 0;          ///< Twice what is cut from each side.
};

struct SmoothCorner {
  Junction junction = Junction::Stop;  ///< Smooth: in curvature, too.
  SmoothBlend blend;
};

/// The same for machines whose jerk is limited, which may gather speed in corners: no more than all of each element is
/// cut off, half from each end.
SmoothCorner smooth_corner(const Machine& machine, const Element& before, const Element& after);

}  // namespace isocnc::motion
