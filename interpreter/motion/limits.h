#pragma once

#include <array>

#include "interpreter/motion/machine.h"
#include "interpreter/motion/path.h"

namespace isocnc::motion {

enum class Direction : std::int8_t { Forward = 1, Backward = -1 };

/// What the axes allow on a piece of a curve, in x, the square of ds/dt, and a, the second derivative of s: for each
/// axis |q'' x + q' a| <= its acceleration, wherever on the piece. q'' and q' are taken at both ends; what they stray
/// from the straight line between them is at most h^2/8 times the next derivative but one, and added.
///
/// x stays below the speed that can be held: a = 0 is always possible.
class CurveLimits {
 public:
  CurveLimits(const Machine& machine, const Path& path, double from, double to);

  /// Most x by the limits of the axes.
  double cap() const { return cap_; }
  /// Most x at one end with x at the other: after it in Direction::Forward, before it in Direction::Backward.
  double reach(double x, Direction direction) const;
  /// Most |a| that is possible at x and all the way to the larger `peak`.
  double acceleration(double x, double peak, Direction direction) const;

 private:
  /// m x + n |a| <= 1.
  struct Bound {
    double m = 0;
    double by_n = 0;       ///< 1 / n.
    double by_length = 0;  ///< 1 / (n + 2 length m), m if positive: with x at the other end.
  };
  /// Of one direction. Each axis has four at most: at both ends, of both signs.
  struct Bounds {
    std::array<Bound, std::size_t{4} * kAxisCount> bounds;
    std::size_t count = 0;
  };

  void add(Direction direction, double m, double n);
  const Bounds& bounds(Direction direction) const { return direction == Direction::Forward ? forward_ : backward_; }

  Bounds forward_;
  Bounds backward_;
  double length_ = 0;
  double cap_ = 0;
};

/// What the axes allow on a line of joints.
struct LineLimits {
  double cap = 0;           ///< Most x.
  double acceleration = 0;  ///< Most |a|.
};

LineLimits line_limits(const Machine& machine, const Coordinates& joint_slope);

}  // namespace isocnc::motion
