#pragma once

#include "interpreter/geometry/vectors.h"

namespace isocnc::chords {

/// Where, of what a body cuts on its way, the depth of the cut is told: not in the rims at both sides of the way and at
/// its ends. Where a later pass goes along the wall of an earlier one, rounding leaves skins there, as high as the
/// wall.
class CutBand {
 public:
  /// All places.
  CutBand() = default;

  /// Of a straight way of a body with a vertical axis; a plunge if both ends are the same.
  static CutBand along_line(const geometry::Vec2& from, const geometry::Vec2& to, double radius, double side_rim,
                            double end_rim);
  /// Of a way across an axis in any direction, of any length. Its ends count.
  static CutBand along_slanted(const geometry::Vec3& from, const geometry::Vec3& axis, const geometry::Vec3& travel,
                               double radius, double side_rim);
  /// Of a level arc, counterclockwise seen from above, of at most half a turn; `start` and `end` are from its center.
  static CutBand along_arc(const geometry::Vec2& center, const geometry::Vec2& start, const geometry::Vec2& end,
                           double radius, double side_rim, double end_rim);

  bool contains(const geometry::Vec3& point) const;

 private:
  enum class Kind : unsigned char { All, Line, Slanted, Arc };

  bool is_near_ends(const geometry::Vec2& place) const;

  Kind kind_ = Kind::All;
  geometry::Vec3 from_ = geometry::Vec3::Zero();    ///< Of an arc, its center.
  geometry::Vec3 normal_ = geometry::Vec3::Zero();  ///< Unit vector to the side of the way.
  geometry::Vec2 ends_[2] = {geometry::Vec2::Zero(), geometry::Vec2::Zero()};
  double length_ = 0;  ///< Of a line; of an arc, its radius.
  double half_width_ = 0;
  double end_radius_ = 0;
};

}  // namespace isocnc::chords
