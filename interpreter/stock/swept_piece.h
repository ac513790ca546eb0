#pragma once

#include <array>
#include <limits>
#include <span>

#include "interpreter/chords/line_chord.h"
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

  /// A disc of the body across its axis, along the travel.
  struct SweptDisc {
    geometry::Vec3 center = geometry::Vec3::Zero();
    double radius = 0;
  };

  HeightInterval sharp_chord(const geometry::Vec2& line) const;
  HeightInterval rounded_chord(const geometry::Vec2& line) const;
  void include_disc(const SweptDisc& disc, const geometry::Vec2& line, HeightInterval& result) const;
  void include_edge(const SweptEdge& edge, const geometry::Vec2& line, HeightInterval& result) const;
  void find_edges();
  geometry::Vec3 out_of_core(const geometry::Vec3& point) const;
  double bound_of_core(const geometry::Vec2& line, double from, double direction) const;

  solids::BodyPiece piece_;
  solids::AxisPlacement from_;
  geometry::Vec3 travel_;
  bool moves_ = false;
  bool is_ball_ = false;
  solids::PlacedFrustum core_;
  chords::FrustumChord at_start_;
  chords::FrustumChord at_end_;
  solids::BoundingBox bounds_;
  std::array<SweptEdge, 2> edges_;
  int edge_count_ = 0;
  std::array<SweptDisc, 2> discs_;
  double rise_ = 0;  ///< Of the travel along the axis.
  double travel_square_ = 0;
  bool stays_in_plane_ = false;                     ///< Whether discs move in their own plane.
  double step_ = 0;                                 ///< Growth with z of the share of the travel, see include_disc.
  geometry::Vec3 drift_ = geometry::Vec3(0, 0, 1);  ///< Growth with z of the distance from the disc's center.
  double drift_square_ = 1;
};

/// Takes the dexels that some pieces of one body pass through.
void sweep(std::span<const SweptPiece> pieces, DexelSink& sink);

}  // namespace isocnc::stock
