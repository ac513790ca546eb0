#pragma once

#include <array>
#include <span>

#include "interpreter/motion/machine.h"
#include "interpreter/motion/path.h"

namespace isocnc::motion {

enum class Direction : std::int8_t { Forward = 1, Backward = -1 };

/// What an axis allows at one end of a piece of a curve: m x + n |a| <= 1.
struct CurveBound {
  double m;
  double n;
  double by_length;  ///< 1 / (n + 2 length m), m if positive: with x at the other end.
};

/// What the axes allow on a piece of a curve, in x, the square of ds/dt, and a, the second derivative of s: for each
/// axis |q'' x + q' a| <= its acceleration, wherever on the piece. q'' and q' are taken at both ends; what they stray
/// from the straight line between them is at most h^2/8 times the next derivative but one, and added.
///
/// x stays below the speed that can be held: a = 0 is always possible.
class CurveLimits {
 public:
  /// The joints at both ends of the piece, and how much they wiggle between.
  CurveLimits(const Machine& machine, const Jet& begin, const Jet& end, const HigherDerivativeBounds& higher,
              double length);

  /// Most x by the limits of the axes.
  double cap() const { return cap_; }
  std::span<const CurveBound> bounds(Direction direction) const {
    return direction == Direction::Forward ? forward_.used() : backward_.used();
  }

 private:
  /// Of one direction. Each axis has four at most: at both ends, of both signs.
  struct Bounds {
    std::array<CurveBound, std::size_t{4} * kAxisCount> bounds;
    std::size_t count = 0;
    std::span<const CurveBound> used() const { return std::span(bounds).first(count); }
  };

  void add(Bounds& bounds, double m, double n) const;

  Bounds forward_;
  Bounds backward_;
  double length_;
  double cap_;
};

CurveLimits curve_limits(const Machine& machine, const Path& path, double from, double to);

/// Most x at the end of a piece with `x` at its begin, or the other way around for bounds in Direction::Backward. What
/// caps x is not among the bounds.
double reach(std::span<const CurveBound> bounds, double length, double x);

/// Most |a| that is possible at x and all the way to the larger `peak`.
double acceleration(std::span<const CurveBound> bounds, double x, double peak);

/// What the axes allow on a line of joints, or wherever limits are constant.
struct LineLimits {
  double cap = 0;           ///< Most x.
  double acceleration = 0;  ///< Most |a| at x = 0.
  double fall = 0;          ///< By this part of it less for each unit of x: |a| <= acceleration (1 - fall x).
};

LineLimits line_limits(const Machine& machine, const Coordinates& joint_slope);

/// What they allow all along a circle of joints, as if everything were the most at one place.
LineLimits circle_limits(const Machine& machine, const Path& circle);

/// Most of the absolute values of the joints' derivatives anywhere on a piece of a path.
struct DerivativeBounds {
  Coordinates first = Coordinates::Zero();
  Coordinates second = Coordinates::Zero();
  Coordinates third = Coordinates::Zero();
};

DerivativeBounds derivative_bounds(const Kinematics& kinematics, const Path& path, double from, double to);

/// The time over which the mean of a motion is taken on a machine whose jerk is limited: so long that each axis can use
/// its acceleration where its speed leaves room for that. 0 where no jerk is limited.
double smoothing_window(const Machine& machine);

/// How a motion is smoothed.
struct Smoothing {
  double window = 0;         ///< Over which the mean is taken, s.
  double curves_part = 0.8;  ///< Of the jerk, what the speed in curves takes at most: the rest is for changing it.
};

/// Limits of a motion whose mean over the window is within those of the axes on a piece of a path, jerk included, if it
/// keeps them all the time, no two of its accelerations within a window are of different signs, and x is `cap` at most
/// (docs/motion.md).
LineLimits smoothed_limits(const Machine& machine, const Smoothing& smoothing, const DerivativeBounds& bounds,
                           double cap);

}  // namespace isocnc::motion
