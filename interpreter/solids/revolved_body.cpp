#include "interpreter/solids/revolved_body.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace isocnc::solids {

RevolvedBody::RevolvedBody(std::vector<BodyPiece> pieces)
    : pieces_(std::move(pieces)),
      bottom_(std::numeric_limits<double>::infinity()),
      top_(-std::numeric_limits<double>::infinity()) {
  for (const BodyPiece& piece : pieces_) {
    bottom_ = std::min(bottom_, piece.core.bottom - piece.rounding);
    top_ = std::max(top_, piece.core.top + piece.rounding);
    max_radius_ = std::max(max_radius_, std::max(piece.core.bottom_radius, piece.core.top_radius) + piece.rounding);
  }
  sphere_radius_ = reach(middle());
}

/// The distance from a point of the axis is a convex function, so the farthest points are on the rims.
double RevolvedBody::reach(double z) const {
  double farthest = 0;
  for (const BodyPiece& piece : pieces_) {
    const Frustum& core = piece.core;
    farthest = std::max(farthest, piece.rounding + std::max(std::hypot(core.bottom - z, core.bottom_radius),
                                                            std::hypot(core.top - z, core.top_radius)));
  }
  return farthest;
}

}  // namespace isocnc::solids
