#pragma once

#include <memory>
#include <optional>

#include "interpreter/solids/clearance.h"

namespace isocnc::solids {

/// The surface of what lies deeper than `depth` below the surface of a closed mesh. A cutter that stays clear of it
/// goes nowhere deeper than that into the part, whatever the slope of its surface.
///
/// Each face is shifted inwards. At an outer edge the shifted faces end where they meet. Around an inner edge, as
/// between the floor and the wall of a pocket, facets join them, one for at most 30 degrees: they are tangent to the
/// round surface, and between two of them it is up to 3.5 % deeper. At a corner where inner edges meet, the facets
/// leave a hole that is about as wide as `depth`.
///
/// Faces that are near one another without a common edge, as those of a thin rib, do not shorten each other. So the
/// surface may have parts that are less deep, and clearance() asks how deep a point really is.
class InnerSurface {
 public:
  /// `whole` is closed and faces outwards; `depth` in mm, positive.
  InnerSurface(std::shared_ptr<const Mesh> whole, double depth);

  const Mesh& whole() const { return *whole_; }
  double depth() const { return depth_; }
  /// Null if nothing is that deep.
  const Mesh* faces() const { return faces_ ? &*faces_ : nullptr; }

 private:
  std::shared_ptr<const Mesh> whole_;
  double depth_;
  std::optional<Mesh> faces_;
};

/// Bounds on the distance of a body from what lies deeper than inner.depth() in a closed mesh, as clearance() has them.
/// Where the body reaches it, both bounds are minus the depth of the deepest of some points of the body in the mesh,
/// less inner.depth(); the point of the obstacle is one of the mesh's surface. Where the body is near a face of the
/// inner surface that is less deep, so that nothing can be proven, the lower bound is a guess from points of the body.
Clearance clearance(const RevolvedBody& body, const AxisPlacement& at, const InnerSurface& inner,
                    double sufficient = kExact);

/// The same for a body that reaches the inner surface, with its deepest point sought with care: the depth in the mesh
/// is nearly always right within 5 %. Takes some three times as long.
Clearance deepest(const RevolvedBody& body, const AxisPlacement& at, const InnerSurface& inner);

}  // namespace isocnc::solids
