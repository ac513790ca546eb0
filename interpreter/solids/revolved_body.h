#pragma once

#include <optional>
#include <span>
#include <vector>

#include "interpreter/solids/frustum.h"

namespace isocnc::solids {

/// A convex piece of a body of revolution: all points within `rounding` of a frustum. With a disc or a point as its
/// frustum, it is the end of a bull nose or a ball nose.
struct BodyPiece {
  Frustum core;
  double rounding = 0;  ///< mm, not negative.
};

/// A body of revolution: a cutter, a shank, a holder, a nose, a saw blade. It is the union of its pieces, in its own
/// frame: z along its axis, for a tool from the tip (z = 0) towards the spindle, mm. Made by the functions of
/// tool_shapes.h.
///
/// A saw blade has its own axis, which is not the spindle's. The body does not know: where it stands in space is for
/// the caller to say, by an AxisPlacement for each body.
class RevolvedBody {
 public:
  /// Requires at least one piece, with finite values as BodyPiece and Frustum demand them.
  explicit RevolvedBody(std::vector<BodyPiece> pieces);

  std::span<const BodyPiece> pieces() const { return pieces_; }
  double bottom() const { return bottom_; }                ///< Smallest z, mm.
  double top() const { return top_; }                      ///< Largest z, mm.
  double maximum_radius() const { return max_radius_; }    ///< Largest distance from the axis, mm.
  double middle() const { return (bottom_ + top_) / 2; }   ///< z of the center of the sphere around the body, mm.
  double sphere_radius() const { return sphere_radius_; }  ///< Radius of that sphere, mm.

  /// Largest distance of any point of the body from the point of its axis at `z`, mm. Where that point moves at the
  /// speed u and the axis turns at w radians, no point of the body moves faster than u + w reach(z).
  double reach(double z) const;

  /// The body without all points that are nearer than `depth` to its surface, so that finishing at distance 0 stays
  /// clear of the target, and a contact of what remains is a gouge deeper than `depth`; empty if nothing remains.
  /// `depth` in mm, not negative.
  ///
  /// The upper end stays, because shank and holder continue there. The result is never larger than the exact one. It is
  /// smaller only where the profile steps inwards or rounds by less than `depth`: by less than 0.3 `depth` at a
  /// rounding that vanishes, and 0.01 `depth` or 0.002 mm at the edge of a step.
  std::optional<RevolvedBody> reduced(double depth) const;

 private:
  std::vector<BodyPiece> pieces_;
  double bottom_ = 0;
  double top_ = 0;
  double max_radius_ = 0;
  double sphere_radius_ = 0;
};

}  // namespace isocnc::solids
