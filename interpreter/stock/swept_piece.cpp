#include "interpreter/stock/swept_piece.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace isocnc::stock {

using geometry::Vec2;
using geometry::Vec3;
using solids::Frustum;

namespace {

constexpr double kParallelSine = 1e-9;
constexpr double kConverged = 1e-7;  // mm
constexpr double kNoSkin = 1e-4;     ///< Pieces of a body that are so near, mm, have nothing between them.

/// Without the upper part of its core that is above `ceiling` all along the travel.
solids::BodyPiece below(double ceiling, const solids::BodyPiece& piece, const solids::AxisPlacement& at,
                        const Vec3& travel) {
  solids::BodyPiece result = piece;
  Frustum& core = result.core;
  const double height = core.top - core.bottom;
  if (!(at.axis.z() > 0.01) || !(height > 0) || !std::isfinite(ceiling)) return result;
  const double radius = std::max(core.bottom_radius, core.top_radius);
  const double drop = radius * std::sqrt(std::max(0.0, 1 - at.axis.z() * at.axis.z())) + piece.rounding;
  const double most = (ceiling + drop - std::min(0.0, travel.z()) - at.at(core.bottom).z()) / at.axis.z();
  if (most >= height || most <= 0) return result;
  core.top = core.bottom + most;
  core.top_radius = core.bottom_radius + most / height * (core.top_radius - core.bottom_radius);
  return result;
}

}  // namespace

SweptPiece::SweptPiece(const solids::BodyPiece& piece, const solids::AxisPlacement& at, const Vec3& travel,
                       double ceiling)
    : piece_(below(ceiling, piece, at, travel)),
      from_(at),
      travel_(travel),
      moves_(travel.squaredNorm() > 0),
      core_(piece_.core, at),
      at_start_(piece_.core, at),
      at_end_(piece_.core, {at.origin + travel, at.axis}) {
  const Frustum& core = piece_.core;
  is_ball_ = core.top == core.bottom && core.bottom_radius == 0 && core.top_radius == 0;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 unit = Vec3::Unit(axis);
    bounds_.min()[axis] = core_.lowest(unit) - piece.rounding + std::min(0.0, travel[axis]);
    bounds_.max()[axis] = core_.highest(unit) + piece.rounding + std::max(0.0, travel[axis]);
  }
  if (!moves_ || is_ball_) return;
  find_edges();
  discs_ = {SweptDisc{at.at(core.bottom), core.bottom_radius}, SweptDisc{at.at(core.top), core.top_radius}};
  rise_ = travel.dot(at.axis);
  travel_square_ = travel.squaredNorm();
  stays_in_plane_ = std::abs(rise_) <= kParallelSine * travel.norm();
  if (stays_in_plane_) return;
  step_ = at.axis.z() / rise_;
  drift_ = Vec3(0, 0, 1) - step_ * travel;
  drift_square_ = drift_.squaredNorm();
}

/// The straight lines on the side of the core along which the travel touches it: with the outward normal
/// n = height radial - widening axis, where n . travel = 0.
void SweptPiece::find_edges() {
  const Frustum& core = piece_.core;
  const double height = core.top - core.bottom;
  if (!(height > 0)) return;
  const Vec3 across = travel_ - travel_.dot(from_.axis) * from_.axis;
  const double length = across.norm();
  if (!(length > kParallelSine * travel_.norm())) return;
  const Vec3 forward = across / length;
  const Vec3 aside = from_.axis.cross(forward);
  const double cosine = (core.top_radius - core.bottom_radius) * travel_.dot(from_.axis) / (height * length);
  if (!(std::abs(cosine) <= 1)) return;
  const double sine = std::sqrt(1 - cosine * cosine);
  for (const double side : {-1.0, 1.0}) {
    const Vec3 radial = cosine * forward + side * sine * aside;
    edges_[static_cast<std::size_t>(edge_count_++)] = {
        .corner = from_.at(core.bottom) + core.bottom_radius * radial,
        .along = height * from_.axis + (core.top_radius - core.bottom_radius) * radial};
  }
}

HeightInterval SweptPiece::chord(const Vec2& line) const {
  if (is_ball_) {
    const Vec3 center = from_.at(piece_.core.bottom);
    return chords::capsule_chord(center, center + travel_, piece_.rounding, line);
  }
  return piece_.rounding > 0 ? rounded_chord(line) : sharp_chord(line);
}

/// The surface of the sweep consists of that of the piece at both ends, and of what the curves on it sweep along which
/// the travel touches it: both rims, and two straight lines.
HeightInterval SweptPiece::sharp_chord(const Vec2& line) const {
  HeightInterval result = at_start_.of(line);
  if (!moves_) return result;
  result.include(at_end_.of(line));
  for (const SweptDisc& disc : discs_) include_disc(disc, line, result);
  for (int i = 0; i < edge_count_; ++i) include_edge(edges_[static_cast<std::size_t>(i)], line, result);
  return result;
}

/// A point of the line is at the parameter s of the travel at which it lies in the plane of the disc; both s and its
/// distance from the disc's center are linear in z.
void SweptPiece::include_disc(const SweptDisc& disc, const Vec2& line, HeightInterval& result) const {
  if (!(disc.radius > 0)) return;
  const Vec3 w(line.x() - disc.center.x(), line.y() - disc.center.y(), -disc.center.z());
  const double h = w.dot(from_.axis);
  if (stays_in_plane_) {
    if (std::abs(from_.axis.z()) < kParallelSine) return;
    const double z = -h / from_.axis.z();
    const Vec3 point = w + Vec3(0, 0, z);
    const double share = std::clamp(point.dot(travel_) / travel_square_, 0.0, 1.0);
    if ((point - share * travel_).squaredNorm() <= disc.radius * disc.radius) result.include(z);
    return;
  }
  const double start = h / rise_;
  HeightInterval inside{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  if (std::abs(step_) < 1e-14) {
    if (start < 0 || start > 1) return;
  } else {
    const double one = -start / step_;
    const double other = (1 - start) / step_;
    inside = {std::min(one, other), std::max(one, other)};
  }
  const Vec3 p = w - start * travel_;
  const double c = p.squaredNorm() - disc.radius * disc.radius;
  if (drift_square_ < 1e-14) {
    if (c > 0) return;
  } else {
    const double b = p.dot(drift_);
    const double discriminant = b * b - drift_square_ * c;
    if (!(discriminant >= 0)) return;
    const double root = std::sqrt(discriminant);
    inside.clip({(-b - root) / drift_square_, (-b + root) / drift_square_});
  }
  if (inside.bottom <= inside.top && std::isfinite(inside.bottom) && std::isfinite(inside.top)) result.include(inside);
}

void SweptPiece::include_edge(const SweptEdge& edge, const Vec2& line, HeightInterval& result) const {
  const Vec2 to_line = line - edge.corner.head<2>();
  const double size = edge.along.x() * travel_.y() - edge.along.y() * travel_.x();
  if (!(std::abs(size) > 1e-12)) return;
  const double u = (to_line.x() * travel_.y() - to_line.y() * travel_.x()) / size;
  const double v = (edge.along.x() * to_line.y() - edge.along.y() * to_line.x()) / size;
  if (u < 0 || u > 1 || v < 0 || v > 1) return;
  result.include(edge.corner.z() + u * edge.along.z() + v * travel_.z());
}

/// From the nearest point of the swept core to a point. Where along the travel this is, is found by the secant method
/// with halving; any other place gives a longer vector, which leaves too much material rather than too little.
Vec3 SweptPiece::out_of_core(const Vec3& point) const {
  const auto out_at = [&](double s) {
    const Vec3 shifted = point - s * travel_;
    return Vec3(shifted - core_.nearest(shifted));
  };
  Vec3 out = out_at(0);
  if (!moves_) return out;
  double low = 0;
  double low_slope = -out.dot(travel_);  // Grows with s.
  if (low_slope >= 0) return out;
  double high = 1;
  const Vec3 out_at_end = out_at(1);
  double high_slope = -out_at_end.dot(travel_);
  if (high_slope <= 0) return out_at_end;
  const double tolerance = kConverged / travel_.norm();
  for (int i = 0; i < 40 && high - low > tolerance; ++i) {
    const double s = i % 3 == 2 ? (low + high) / 2 : low - low_slope * (high - low) / (high_slope - low_slope);
    out = out_at(s);
    const double slope = -out.dot(travel_);
    if (std::abs(slope) <= 1e-12) break;
    if (slope < 0) {
      low = s;
      low_slope = slope;
    } else {
      high = s;
      high_slope = slope;
    }
  }
  return out;
}

/// The distance from the core is convex along the line, so that Newton's method from outside does not overshoot.
/// Returns NaN if the line passes at more than the rounding.
double SweptPiece::bound_of_core(const Vec2& line, double from, double direction) const {
  double z = from;
  for (int i = 0; i < 60; ++i) {
    const Vec3 out = out_of_core(Vec3(line.x(), line.y(), z));
    const double distance = out.norm();
    const double beyond = distance - piece_.rounding;
    if (beyond <= kConverged) return z;
    const double approach = -direction * out.z() / distance;
    if (!(approach > kParallelSine)) break;
    z += direction * beyond / approach;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

HeightInterval SweptPiece::rounded_chord(const Vec2& line) const {
  const double bottom = bound_of_core(line, bounds_.min().z() - kConverged, 1);
  if (std::isnan(bottom)) return {};
  const double top = bound_of_core(line, bounds_.max().z() + kConverged, -1);
  return std::isnan(top) ? HeightInterval() : HeightInterval{bottom, top};
}

void sweep(std::span<const SweptPiece> pieces, DexelSink& sink) {
  const DexelGrid& grid = sink.grid();
  struct Window {
    const SweptPiece* piece;
    int first_row, last_row, first, last;
  };
  std::vector<Window> windows;
  Window all{nullptr, grid.rows, 0, grid.columns, 0};
  for (const SweptPiece& piece : pieces) {
    const solids::BoundingBox& box = piece.bounds();
    if (!sink.has_material_in({box.min().z(), box.max().z()})) continue;
    const Window window{&piece, grid.first_row(box.min().y()), grid.first_row(box.max().y()),
                        grid.first_column(box.min().x()), grid.first_column(box.max().x())};
    if (window.first_row >= window.last_row || window.first >= window.last) continue;
    windows.push_back(window);
    all.first_row = std::min(all.first_row, window.first_row);
    all.last_row = std::max(all.last_row, window.last_row);
    all.first = std::min(all.first, window.first);
    all.last = std::max(all.last, window.last);
  }
  std::vector<HeightInterval> met;
  for (int row = all.first_row; row < all.last_row; ++row) {
    for (int column = all.first; column < all.last; ++column) {
      sink.set(column - all.first, {});
      const Vec2 line(grid.x(column), grid.y(row));
      met.clear();
      for (const Window& window : windows) {
        if (row < window.first_row || row >= window.last_row || column < window.first || column >= window.last)
          continue;
        const HeightInterval interval = window.piece->chord(line);
        if (!interval.is_empty()) met.push_back(interval);
      }
      if (met.empty()) continue;
      std::sort(met.begin(), met.end(),
                [](const HeightInterval& left, const HeightInterval& right) { return left.bottom < right.bottom; });
      HeightInterval present = met.front();
      for (const HeightInterval& next : met) {
        if (next.bottom > present.top + kNoSkin) {
          sink.take_apart(row, column, present);
          present = next;
        }
        present.include(next);
      }
      sink.set(column - all.first, present);
    }
    sink.take_row(row, all.first, all.last);
  }
}

}  // namespace isocnc::stock
