#pragma once

#include <array>
#include <limits>
#include <span>

#include "interpreter/solids/obstacle.h"
#include "interpreter/solids/revolved_body.h"
#include "interpreter/stock/dexel_sink.h"

namespace isocnc::stock {

/// What a convex piece of a body passes through while it moves along a straight line without turning. This is convex,
/// too, so a vertical line meets it in one interval: in closed form without a rounding and for a ball; else by
/// Newton's method from outside, up to 1e-6 mm.
class SweptPiece {
 public:
  /// `at` is the placement of the body at the start; `travel` may be 0. What lies above `ceiling` may be left out.
  SweptPiece(const solids::BodyPiece& piece, const solids::AxisPlacement& at, const geometry::Vec3& travel,
             double ceiling = std::numeric_limits<double>::infinity());

  const solids::BoundingBox& bounds() const { return bounds_; }
  HeightInterval chord(const geometry::Vec2& line) const;

 private:
  /// A parallelogram with one side along the travel.
  struct SweptEdge {
    geometry::Vec3 corner;
    geometry::Vec3 along;
  };

  HeightInterval sharp_chord(const geometry::Vec2& line) const;
  HeightInterval rounded_chord(const geometry::Vec2& line) const;
  void include_disc(double z, double radius, const geometry::Vec2& line, HeightInterval& result) const;
  void include_edge(const SweptEdge& edge, const geometry::Vec2& line, HeightInterval& result) const;
  void find_edges();
  geometry::Vec3 out_of_core(const geometry::Vec3& point) const;
  double bound_of_core(const geometry::Vec2& line, double from, double direction) const;

  solids::BodyPiece piece_;
  solids::AxisPlacement from_;
  solids::AxisPlacement to_;
  geometry::Vec3 travel_;
  bool moves_ = false;
  bool is_ball_ = false;
  solids::PlacedFrustum core_;
  solids::BoundingBox bounds_;
  std::array<SweptEdge, 2> edges_;
  int edge_count_ = 0;
};

/// Takes the dexels that some pieces of one body pass through.
void sweep(std::span<const SweptPiece> pieces, DexelSink& sink);

}  // namespace isocnc::stock
