#pragma once

#include <vector>

#include <Eigen/Geometry>

namespace isocnc::outline {

using OutlinePoint = Eigen::Vector2d;       ///< X and Y, mm.
using Contour = std::vector<OutlinePoint>;  ///< The corners of a closed polygon, counterclockwise.

/// What round tools cover on their way, seen from above. It keeps every stroke, 40 bytes each.
class CoveredArea {
 public:
  /// A tool of this radius goes straight from one point to the other; mm.
  void add(const OutlinePoint& from, const OutlinePoint& to, double radius);

  bool is_empty() const { return strokes_.empty(); }

  /// The smallest rectangle along X and Y around all of it.
  Contour rectangle() const;
  /// A convex polygon around all of it, at most 0.3 % of the largest radius away from the smallest.
  Contour hull() const;
  /// The outlines of its separate parts, holes left out, in any order. They go around it at a distance of at most
  /// kContourTolerance of its longer side, and touch nothing of it.
  std::vector<Contour> contours() const;

  static constexpr double kContourTolerance = 0.004;

 private:
  struct Stroke {
    OutlinePoint from;
    OutlinePoint to;
    double radius = 0;
  };

  std::vector<double> radii() const;
  Eigen::AlignedBox2d bounds() const;

  std::vector<Stroke> strokes_;
};

}  // namespace isocnc::outline
