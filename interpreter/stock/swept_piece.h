#pragma once

#include <array>
#include <limits>
#include <optional>
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

  bool contains(const geometry::Vec3& point) const;
  const geometry::Vec3& axis() const { return from_.axis; }

  /// From where to where along x the lines at a y may meet the sweep: a polygon around its shadow.
  HeightInterval shadow(double y) const;
  /// Of the `count` lines at x, x + step, and so on, all at y, sets a number above 0 for those that surely meet nothing
  /// at their tops and below: there is a plane that leaves the sweep on its one side, and that part of the line on the
  /// other one.
  void clear(double x, double step, double y, int count, const float* tops, float* clearances) const;
  /// The chords of a ball, as CapsuleChord::of_row(). Null for another piece.
  const chords::CapsuleChord* ball() const { return ball_ ? &*ball_ : nullptr; }

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
  /// Vertical lines in a row, as seen from base_.
  struct FloatLines {
    float first;
    float spacing;
    float dy;
    float base_z;
  };
  FloatLines floats_from_base(double x, double step, double y) const;
  void clear_core(double x, double step, double y, int count, const float* tops, float* clearances) const;
  void clear_cylinder(double x, double step, double y, int count, const float* tops, float* clearances) const;
  void clear_ball(double x, double step, double y, int count, const float* tops, float* clearances) const;
  void find_edges();
  void find_shadow();
  void find_floats();
  geometry::Vec3 out_of_core(const geometry::Vec3& point) const;
  double bound_of_core(const geometry::Vec2& line, double from, double direction) const;

  solids::BodyPiece piece_;
  solids::AxisPlacement from_;
  geometry::Vec3 base_;  ///< Of the core, at the start.
  geometry::Vec3 travel_;
  bool moves_ = false;
  solids::PlacedFrustum core_;
  chords::FrustumChord at_start_;
  chords::FrustumChord at_end_;
  std::optional<chords::CapsuleChord> ball_;  ///< If it is one.
  solids::BoundingBox bounds_;
  /// x = at + slope y, a line that the shadow has on one side.
  struct ShadowSide {
    double at = 0;
    double slope = 0;
  };
  static constexpr int kShadowSides = 8;
  std::array<ShadowSide, kShadowSides> left_;
  std::array<ShadowSide, kShadowSides> right_;
  /// The sweep as clear() has it.
  struct FloatForm {
    std::array<float, 3> axis;
    std::array<float, 3> travel;
    std::array<float, 3> across;  ///< The travel across the axis, of a ball all of it, by the square of its length.
    float rise;                   ///< The travel along the axis.
    float height;
    float low_radius;
    float high_radius;
    float growth;
    float rounding;  ///< With a margin.
  };
  FloatForm floats_;
  bool is_cylinder_ = false;  ///< That clear_cylinder() is for.
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

/// The bounds of a piece along a straight line, as SweptPiece has them.
solids::BoundingBox swept_bounds(const solids::BodyPiece& piece, const solids::AxisPlacement& at,
                                 const geometry::Vec3& travel);

/// Takes the dexels that some pieces of one body pass through.
void sweep(std::span<const SweptPiece> pieces, DexelSink& sink);

}  // namespace isocnc::stock
