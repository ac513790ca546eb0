#pragma once

#include <array>
#include <span>

#include "interpreter/geometry/range.h"
#include "interpreter/kinematics/machine.h"
#include "interpreter/kinematics/path.h"

// Limits of the motion along a path. s is the path parameter in mm (or degrees, where B and C alone move), x the
// square of ds/dt in mm^2/s^2, a the second derivative of s by time in mm/s^2. q is a joint's position, and q', q'',
// q''' its derivatives by s.

namespace isocnc::kinematics {

enum class Direction : std::int8_t { Forward = 1, Backward = -1 };

/// The limit of one axis at one end of a piece of a curve: m x + n |a| <= 1.
struct CurveBound {
  double m;
  double n;
  double by_length;  ///< 1 / (n + 2 length max(m, 0)), which gives |a| from x at the piece's other end.
};

/// By how much a joint's first two derivatives deviate at most from the straight line between the ends of a piece.
struct Slack {
  double first = 0;
  double second = 0;
};

/// The limits of all axes on a piece of a curve: |q'' x + q' a| <= acceleration for each axis everywhere on the piece.
/// q'' and q' are computed at both ends. Between the ends they deviate from the straight line by at most h^2/8 times
/// their second derivatives, for a piece of length h; this slack is added.
///
/// x is capped at the maximum for which a = 0 is possible, so a speed within the cap can always be held.
class CurveLimits {
 public:
  /// `begin`, `end`: the joints at both ends of the piece. `higher`: bounds of the joints' third and fourth derivatives
  /// between them.
  CurveLimits(const Machine& machine, const Derivatives& begin, const Derivatives& end,
              const HigherDerivativeBounds& higher, double length);

  /// Returns the maximum of x by the speeds and accelerations of the axes.
  double cap() const { return cap_; }
  std::span<const CurveBound> bounds(Direction direction) const {
    return direction == Direction::Forward ? forward_.used() : backward_.used();
  }

 private:
  /// Bounds of one direction: at most four for each axis, one for each end and sign.
  struct Bounds {
    std::array<CurveBound, std::size_t{4} * kAxisCount> bounds;
    std::size_t count = 0;
    std::span<const CurveBound> used() const { return std::span(bounds).first(count); }
  };

  void add(double part, const geometry::Range& slope, const geometry::Range& bend, const Slack& slack);

  Bounds forward_;
  Bounds backward_;
  double length_;  ///< Length of the piece, mm or degrees.
  double cap_;     ///< Maximum of x.
};

/// Returns the cap of x on a piece on which the derivatives of the joints change linearly from end to end: every speed
/// up to it can be held.
double curve_cap(const Machine& machine, const Derivatives& begin, const Derivatives& end);

/// Returns a cap of x on a path of the tip from s = 0 to `length`: every speed up to it can be held. Of the ends alone
/// where the slack between them takes little, else the smallest of several parts. `begin`, `end`: of the joints there.
double curve_cap(const Machine& machine, const Path& path, double length, const Derivatives& begin,
                 const Derivatives& end);

/// Returns the maximum of x at the end of a piece that starts with `x`, or with bounds of Direction::Backward, at the
/// start of a piece that ends with `x`. The caller applies the cap of x.
double reach(std::span<const CurveBound> bounds, double length, double x);

/// Returns the maximum of |a| that is possible at every square of the speed from x up to `peak`.
double acceleration(std::span<const CurveBound> bounds, double x, double peak);

/// Constant limits: those of a line of the joints, or of any interval on which the strictest values are applied.
struct LineLimits {
  double cap = 0;           ///< Maximum of x, mm^2/s^2.
  double acceleration = 0;  ///< Maximum of |a| at x = 0, mm/s^2.
  double fall = 0;          ///< Relative decrease of that maximum per unit of x: |a| <= acceleration (1 - fall x).
};

/// Returns the limits on a line of the joints with this first derivative by s.
LineLimits line_limits(const Machine& machine, const Coordinates& joint_slope);

/// Returns limits that hold everywhere on a circle of the joints. Each derivative is taken at its maximum.
LineLimits circle_limits(const Machine& machine, const Path& circle);

/// Upper bounds of the absolute values of all joints' derivatives by s on a piece of a path.
struct DerivativeBounds {
  Coordinates first = Coordinates::Zero();
  Coordinates second = Coordinates::Zero();
  Coordinates third = Coordinates::Zero();
};

DerivativeBounds derivative_bounds(const Kinematics& kinematics, const Path& path, double from, double to);

/// Returns the longest useful window for the mean of a motion on a machine whose jerk is limited, s. With it each axis
/// reaches its maximum acceleration where its maximum speed leaves time for that. 0 where no jerk is limited.
double smoothing_window(const Machine& machine);

/// The parameters by which a motion is smoothed.
struct Smoothing {
  double window = 0;  ///< Window over which the mean is computed, s.
  double curves_part =
      0.8;  ///< Maximum part of the jerk for holding the speed in curves; changes of speed use the rest.
};

/// Returns limits on a piece of a path for a motion that is then averaged over the window. The mean keeps the limits of
/// the axes on the piece, jerk included, if the motion keeps the returned limits all the time and never has
/// accelerations of both signs within one window (docs/motion.md, "Jerk"). x is `cap` at most.
LineLimits smoothed_limits(const Machine& machine, const Smoothing& smoothing, const DerivativeBounds& bounds,
                           double cap);

}  // namespace isocnc::kinematics
