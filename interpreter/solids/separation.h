#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "interpreter/geometry/vectors.h"

namespace isocnc::solids {

/// What is known of the distance of two convex shapes, mm.
///
/// The proof: for any unit vector n, shape A lies below the plane n . x = A.highest(n), and shape B above n . x =
/// B.lowest(n). So their distance is at least the gap B.lowest(n) - A.highest(n), whatever n is. The search only looks
/// for an n with a large gap, and for two points that are close together: if it stops early or goes astray, the bounds
/// are loose, never wrong. Both values are computed in closed form, with errors far below kRounding.
struct Separation {
  double lower = -std::numeric_limits<double>::infinity();  ///< Largest gap found; proven where it is positive.
  double upper = std::numeric_limits<double>::infinity();   ///< Distance of the two points; 0 if the shapes overlap.
  geometry::Vec3 direction = geometry::Vec3(0, 0, 1);       ///< The n of `lower`, from the first to the second shape.
  geometry::Vec3 on_first = geometry::Vec3::Zero();
  geometry::Vec3 on_second = geometry::Vec3::Zero();

  bool overlaps() const { return upper <= 0; }
};

/// Points nearer than this are taken for the same, mm: the shapes then overlap, or as good as.
inline constexpr double kTouch = 1e-7;
/// Difference of both bounds at which the search ends, mm.
inline constexpr double kTight = 1e-7;
/// How far overlap() moves shapes apart beyond what separates them, mm.
inline constexpr double kApart = 1e-3;
inline constexpr int kMaxSearchSteps = 64;
/// A gap that no shapes have: the search goes on to the end.
inline constexpr double kExactGap = std::numeric_limits<double>::infinity();

/// Up to four points of the difference B - A, of which the hull's point nearest to 0 is asked for.
class DifferenceHull {
 public:
  struct HullCorner {
    geometry::Vec3 difference;
    geometry::Vec3 on_first;
    geometry::Vec3 on_second;
  };

  /// Adds a point. Requires fewer than four.
  void add(const geometry::Vec3& on_first, const geometry::Vec3& on_second) {
    corners_[count_++] = {on_second - on_first, on_first, on_second};
  }
  /// Finds the point nearest to 0, and drops the corners that do not carry it. Returns whether 0 is in the hull.
  bool reduce();
  bool has(const geometry::Vec3& difference) const;

  const geometry::Vec3& nearest() const { return nearest_; }
  geometry::Vec3 on_first() const;
  geometry::Vec3 on_second() const;

 private:
  using HullWeights = std::array<double, 4>;

  bool encloses_origin() const;
  void consider(const HullWeights& weights, const geometry::Vec3& point);
  void consider_edge(std::size_t a, std::size_t b);
  void consider_face(std::size_t a, std::size_t b, std::size_t c);
  void keep_best();

  std::array<HullCorner, 4> corners_;
  HullWeights weights_ = {1, 0, 0, 0};
  geometry::Vec3 nearest_ = geometry::Vec3::Zero();
  double best_ = 0;  ///< Square of the distance of `nearest_`.
  std::size_t count_ = 0;
};

namespace detail {

/// Takes two points of the shapes, if they are the nearest ones so far.
inline bool take_points(Separation& best, const geometry::Vec3& on_first, const geometry::Vec3& on_second) {
  const double distance = (on_second - on_first).norm();
  if (!(distance < best.upper)) return false;
  best.upper = distance > kTouch ? distance : 0;
  best.on_first = on_first;
  best.on_second = on_second;
  return true;
}

/// Takes the gap along a unit vector, if it is the largest so far.
template <class A, class B>
void take_gap(Separation& best, const A& a, const B& b, const geometry::Vec3& n) {
  const double gap = b.lowest(n) - a.highest(n);
  if (!(gap > best.lower)) return;
  best.lower = gap;
  best.direction = n;
}

/// Whether the search has come to its end.
inline bool is_known(const Separation& best, double sufficient) {
  return best.overlaps() || best.lower >= sufficient || best.upper - best.lower <= kTight;
}

/// Brings both points nearer together, each to the other.
template <class A, class B>
void polish(Separation& best, const A& a, const B& b) {
  constexpr int kRounds = 8;
  for (int i = 0; i < kRounds && !is_known(best, kExactGap); ++i) {
    const geometry::Vec3 on_second = b.nearest(best.on_first);
    if (!take_points(best, a.nearest(on_second), on_second)) return;
    if (!best.overlaps()) take_gap(best, a, b, (best.on_second - best.on_first) / best.upper);
  }
}

/// Looks for the point of the hull of all differences of two points that is nearest to 0, from the best points so far.
/// Keeps up to four such differences, and adds the one that lies farthest towards 0. Stops where rounding does not let
/// it come nearer for more than `patience` steps: between faces that are nearly parallel, the first few steps gain less
/// than a rounding error.
template <class A, class B>
void search(Separation& best, const A& a, const B& b, double sufficient, int patience) {
  int stalled = 0;
  DifferenceHull hull;
  hull.add(best.on_first, best.on_second);
  for (int step = 0; step < kMaxSearchSteps; ++step) {
    const bool encloses = hull.reduce();
    if (encloses && best.lower > 0) return;  // The proven gap outweighs a hull of rounding errors.
    const bool is_nearer = take_points(best, hull.on_first(), hull.on_second());
    stalled = is_nearer || step == 0 ? 0 : stalled + 1;
    if (encloses) best.upper = 0;
    const double length = hull.nearest().norm();
    if (best.overlaps() || !(length > 0) || stalled > patience) return;
    const geometry::Vec3 n = hull.nearest() / length;
    take_gap(best, a, b, n);
    if (is_known(best, sufficient)) return;
    const geometry::Vec3 first = a.highest_point(n);
    const geometry::Vec3 second = b.lowest_point(n);
    if (hull.has(second - first)) return;
    hull.add(first, second);
  }
}

/// Tries the directions of faces. Faces that are parallel but for a tiny angle leave a hull of differences that is too
/// flat to search on, while one of their normals is the direction that is looked for.
template <class A, class B>
void try_normals(Separation& best, const A& a, const B& b) {
  const auto consider = [&](const geometry::Vec3& n) {
    take_gap(best, a, b, n);
    const geometry::Vec3 first = a.highest_point(n);
    take_points(best, first, b.nearest(first));
    const geometry::Vec3 second = b.lowest_point(n);
    take_points(best, a.nearest(second), second);
  };
  const auto consider_both = [&](const geometry::Vec3& n) {
    consider(n);
    consider(-n);
  };
  a.for_each_normal(best.on_second, consider_both);
  b.for_each_normal(best.on_first, consider_both);
  a.for_each_edge([&](const geometry::Vec3& first) {
    b.for_each_edge([&](const geometry::Vec3& second) {
      const geometry::Vec3 across = first.cross(second);
      if (across.norm() > 1e-6) consider_both(across.normalized());
    });
  });
}

}  // namespace detail

/// Bounds on the distance of two convex shapes. Ends as soon as the lower bound reaches `sufficient`, or both bounds
/// agree within kTight. It starts from two points that are near each other already, which for faces is the end as well.
template <class A, class B>
Separation separation(const A& a, const B& b, double sufficient) {
  constexpr int kSearches = 4;
  constexpr int kPatience = 4;
  Separation best;
  const geometry::Vec3 on_first = a.nearest(b.nearest(a.middle()));
  detail::take_points(best, on_first, b.nearest(on_first));
  for (int i = 0; i < kSearches && !best.overlaps(); ++i) {
    const bool is_last = i + 1 == kSearches;
    detail::search(best, a, b, sufficient, is_last ? kPatience : 0);
    if (detail::is_known(best, sufficient)) return best;
    detail::polish(best, a, b);
    if (detail::is_known(best, sufficient)) return best;
  }
  if (!best.overlaps()) detail::try_normals(best, a, b);
  return best;
}

/// A translation of A by `depth` against `direction` separates A from B.
struct Overlap {
  double depth = std::numeric_limits<double>::infinity();  ///< mm, not negative.
  geometry::Vec3 direction = geometry::Vec3(0, 0, 1);      ///< Unit vector.
};

/// How far two convex shapes that overlap must be moved apart. It is the shortest along the normals of both shapes,
/// across an edge of each, and what a descent from the best of these finds. For boxes and triangles it is the shortest
/// of all; that of round shapes may be shorter, never longer. `across_edges`: starts also across edges, from one
/// shape's middle to the other, as where a tilted cylinder lies on an edge: the edges of the shortest of these ways.
template <class A, class B>
Overlap overlap(const A& a, const B& b, bool across_edges = false) {
  Overlap best;
  const auto consider = [&](const geometry::Vec3& n) {
    const double needed = a.highest(n) - b.lowest(n);
    if (needed < best.depth) best = {needed, n};
  };
  const auto consider_both = [&](const geometry::Vec3& n) {
    consider(n);
    consider(-n);
  };
  a.for_each_normal(b.middle(), consider_both);
  b.for_each_normal(a.middle(), consider_both);
  a.for_each_edge([&](const geometry::Vec3& first) {
    b.for_each_edge([&](const geometry::Vec3& second) {
      const geometry::Vec3 across = first.cross(second);
      if (across.norm() > 1e-6) consider_both(across.normalized());
    });
  });
  // Moved apart along the best direction so far, the shapes are mostly nearest to each other along a better one.
  constexpr int kRounds = 8;
  const auto descend = [&](Overlap from) {
    for (int i = 0; i < kRounds; ++i) {
      const Separation apart = separation(a.moved(-(from.depth + kApart) * from.direction), b, kExactGap);
      const double needed = a.highest(apart.direction) - b.lowest(apart.direction);
      if (apart.overlaps() || !(needed < from.depth)) break;
      from = {needed, apart.direction};
    }
    if (from.depth < best.depth) best = from;
  };
  descend(best);
  if (across_edges) {
    const geometry::Vec3 between = b.nearest(a.middle()) - a.middle();
    const geometry::Vec3 middles = b.middle() - a.middle();
    constexpr std::size_t kMaxStarts = 12;
    std::array<Overlap, kMaxStarts> starts;
    std::size_t count = 0;
    const auto is_shorter = [](const Overlap& x, const Overlap& y) { return x.depth < y.depth; };
    b.for_each_edge([&](const geometry::Vec3& edge) {
      for (const geometry::Vec3& way : {between, middles}) {
        const geometry::Vec3 across = way - way.dot(edge) * edge;
        if (!(across.norm() > 1e-6)) continue;
        const geometry::Vec3 n = across.normalized();
        const Overlap start{a.highest(n) - b.lowest(n), n};
        Overlap& place =
            count < kMaxStarts ? starts[count++] : *std::max_element(starts.begin(), starts.end(), is_shorter);
        if (start.depth < place.depth) place = start;
      }
    });
    for (std::size_t i = 0; i < count; ++i) descend(starts[i]);
  }
  best.depth = std::max(best.depth, 0.0);
  return best;
}

}  // namespace isocnc::solids
