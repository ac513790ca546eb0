#include "interpreter/chords/cut_band.h"

#include <algorithm>
#include <cmath>

namespace isocnc::chords {

using geometry::Vec2;
using geometry::Vec3;

/// What a rim leaves of a radius: half of it at least.
static double without(double rim, double radius) { return std::max(radius - rim, radius / 2); }

CutBand CutBand::along_line(const Vec2& from, const Vec2& to, double radius, double side_rim, double end_rim) {
  CutBand band;
  band.kind_ = Kind::Line;
  band.from_.head<2>() = from;
  band.ends_[0] = from;
  band.ends_[1] = to;
  const Vec2 along = to - from;
  band.length_ = along.norm();
  if (band.length_ > 0) band.normal_ = Vec3(-along.y(), along.x(), 0) / band.length_;
  band.half_width_ = without(side_rim, radius);
  band.end_radius_ = without(band.length_ > 0 ? end_rim : side_rim, radius);
  return band;
}

CutBand CutBand::along_slanted(const Vec3& from, const Vec3& axis, const Vec3& travel, double radius, double side_rim) {
  const Vec3 normal = axis.cross(travel);
  const double size = normal.norm();
  // A plunge.
  if (!(size > 1e-3 * travel.norm())) return {};
  CutBand band;
  band.kind_ = Kind::Slanted;
  band.from_ = from;
  band.normal_ = normal / size;
  band.half_width_ = without(side_rim, radius);
  return band;
}

CutBand CutBand::along_arc(const Vec2& center, const Vec2& start, const Vec2& end, double radius, double side_rim,
                           double end_rim) {
  CutBand band;
  band.kind_ = Kind::Arc;
  band.from_.head<2>() = center;
  band.ends_[0] = center + start;
  band.ends_[1] = center + end;
  band.length_ = start.norm();
  band.half_width_ = without(side_rim, radius);
  band.end_radius_ = without(end_rim, radius);
  return band;
}

bool CutBand::is_near_ends(const Vec2& place) const {
  const double square = end_radius_ * end_radius_;
  return (place - ends_[0]).squaredNorm() <= square || (place - ends_[1]).squaredNorm() <= square;
}

bool CutBand::contains(const Vec3& point) const {
  const Vec3 out = point - from_;
  const auto cross = [](const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); };
  switch (kind_) {
    case Kind::All:
      return true;
    case Kind::Slanted:
      return std::abs(normal_.dot(out)) <= half_width_;
    case Kind::Line: {
      if (std::abs(normal_.dot(out)) > half_width_) return false;
      const double along = normal_.y() * out.x() - normal_.x() * out.y();
      return (along > 0 && along < length_) || is_near_ends(point.head<2>());
    }
    case Kind::Arc: {
      const Vec2 place = out.head<2>();
      if (std::abs(place.norm() - length_) > half_width_) return false;
      const Vec2 center = from_.head<2>();
      const bool is_between = cross(ends_[0] - center, place) > 0 && cross(place, ends_[1] - center) > 0;
      return is_between || is_near_ends(point.head<2>());
    }
  }
  return true;
}

}  // namespace isocnc::chords
