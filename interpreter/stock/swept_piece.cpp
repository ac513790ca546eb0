#include "interpreter/stock/swept_piece.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "interpreter/stock/flat_line.h"

namespace isocnc::stock {

using geometry::Vec2;
using geometry::Vec3;
using solids::Frustum;

namespace {

constexpr double kParallelSine = 1e-9;
constexpr float kTiny = 1e-20F;
constexpr float kHuge = 1e20F;
constexpr double kFloatError = 1e-5;   ///< Far more than rounding to floats moves a point, as a part of the size.
constexpr double kHeightError = 6e-8;  ///< Of a height as a float, as a part of it.
constexpr double kConverged = 1e-7;    // mm
constexpr double kDeep = 2;            ///< A body so far in material, mm, is found by few of its dexels.
constexpr double kNoSkin = 1e-4;       ///< Pieces of a body that are so near, mm, have nothing between them.

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

solids::BoundingBox swept_bounds(const solids::BodyPiece& piece, const solids::AxisPlacement& at, const Vec3& travel) {
  const solids::PlacedFrustum core(piece.core, at);
  solids::BoundingBox bounds;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 unit = Vec3::Unit(axis);
    bounds.min()[axis] = core.lowest(unit) - piece.rounding + std::min(0.0, travel[axis]);
    bounds.max()[axis] = core.highest(unit) + piece.rounding + std::max(0.0, travel[axis]);
  }
  return bounds;
}

SweptPiece::SweptPiece(const solids::BodyPiece& piece, const solids::AxisPlacement& at, const Vec3& travel,
                       double ceiling)
    : piece_(below(ceiling, piece, at, travel)),
      from_(at),
      base_(at.at(piece_.core.bottom)),
      travel_(travel),
      moves_(travel.squaredNorm() > 0),
      core_(piece_.core, at),
      at_start_(piece_.core, at),
      at_end_(piece_.core, {at.origin + travel, at.axis}) {
  const Frustum& core = piece_.core;
  if (core.top == core.bottom && core.bottom_radius == 0 && core.top_radius == 0)
    ball_.emplace(at.at(core.bottom), at.at(core.bottom) + travel, piece_.rounding);
  bounds_ = swept_bounds(piece_, at, travel);
  find_shadow();
  find_floats();
  if (!moves_ || ball_) return;
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

void SweptPiece::find_shadow() {
  static const std::array<Vec2, kShadowSides> kNormals = [] {
    std::array<Vec2, kShadowSides> normals;
    for (std::size_t i = 0; i < kShadowSides; ++i) {
      const double angle = (static_cast<double>(i) - (kShadowSides - 1) / 2.0) * std::numbers::pi / kShadowSides;
      normals[i] = {std::cos(angle), std::sin(angle)};
    }
    return normals;
  }();
  const Frustum& core = piece_.core;
  const Vec2 base = base_.head<2>();
  const Vec2 top = base + (core.top - core.bottom) * from_.axis.head<2>();
  for (std::size_t i = 0; i < kShadowSides; ++i) {
    const Vec2& normal = kNormals[i];
    const double aside = normal.x() * from_.axis.y() - normal.y() * from_.axis.x();
    const double across = std::sqrt(aside * aside + from_.axis.z() * from_.axis.z());
    const double travel = normal.dot(travel_.head<2>());
    const double low = normal.dot(base);
    const double high = normal.dot(top);
    const double low_reach = core.bottom_radius * across;
    const double high_reach = core.top_radius * across;
    const double most = std::max(low + low_reach, high + high_reach) + piece_.rounding + std::max(0.0, travel);
    const double least = std::min(low - low_reach, high - high_reach) - piece_.rounding + std::min(0.0, travel);
    const double slope = -normal.y() / normal.x();
    right_[i] = {most / normal.x(), slope};
    left_[i] = {least / normal.x(), slope};
  }
}

HeightInterval SweptPiece::shadow(double y) const {
  HeightInterval x{bounds_.min().x(), bounds_.max().x()};
  for (std::size_t i = 0; i < kShadowSides; ++i)
    x.clip({left_[i].at + left_[i].slope * y, right_[i].at + right_[i].slope * y});
  return x;
}

SweptPiece::FloatLines SweptPiece::floats_from_base(double x, double step, double y) const {
  return {static_cast<float>(x - base_.x()), static_cast<float>(step), static_cast<float>(y - base_.y()),
          static_cast<float>(base_.z())};
}

/// For each line, any vector n with n.z <= 0 serves for which no point of the sweep is as far along n as the line at
/// its height: what is below is even farther along n. The one from the nearest point of the core, moved by a share of
/// the travel, does where any does, or nearly so. Upwards the same with n.z >= 0. In a loop that becomes vectors.
ISOCNC_VECTOR_CLONES void SweptPiece::clear_core(double x, double step, double y, int count, const float* tops,
                                                 float* clearances) const {
  const FloatForm form = floats_;
  const auto [first, spacing, dy, base_z] = floats_from_base(x, step, y);
  for (int i = 0; i < count; ++i) {
    const float dx = first + static_cast<float>(i) * spacing;
    const float dz = tops[i] - base_z;
    const float ahead = dx * form.across[0] + dy * form.across[1] + dz * form.across[2];
    const float share = 1 - positive(1 - positive(ahead));
    const float px = dx - share * form.travel[0];
    const float py = dy - share * form.travel[1];
    const float pz = dz - share * form.travel[2];
    const float along = px * form.axis[0] + py * form.axis[1] + pz * form.axis[2];
    const float ox = px - along * form.axis[0];
    const float oy = py - along * form.axis[1];
    const float oz = pz - along * form.axis[2];
    const float radius = std::sqrt(ox * ox + oy * oy + oz * oz);
    const float foot = form.height - positive(form.height - positive(along));
    // n = n_along axis + n_out (ox, oy, oz) / radius: across the side, where the foot is within the core.
    const float n_out = positive(radius - (form.low_radius + form.growth * foot));
    const float n_along = along - foot - form.growth * n_out;
    const float unit = n_out / (radius + kTiny);
    const float n_travel =
        n_along * form.rise + unit * (ox * form.travel[0] + oy * form.travel[1] + oz * form.travel[2]);
    const float n_length = std::sqrt(n_along * n_along + n_out * n_out);
    const float at_low = form.low_radius * n_out;
    const float at_high = n_along * form.height + form.high_radius * n_out;
    const float beyond = n_along * along + n_out * radius + share * n_travel - positive(n_travel) - at_low -
                         positive(at_high - at_low) - form.rounding * n_length;
    clearances[i] = beyond - kHuge * positive(n_along * form.axis[2] + unit * oz);
  }
}

/// The same for a ball, of which the nearest point of the core is known: n leads from it to the line.
ISOCNC_VECTOR_CLONES void SweptPiece::clear_ball(double x, double step, double y, int count, const float* tops,
                                                 float* clearances) const {
  const FloatForm form = floats_;
  const auto [first, spacing, dy, base_z] = floats_from_base(x, step, y);
  for (int i = 0; i < count; ++i) {
    const float dx = first + static_cast<float>(i) * spacing;
    const float dz = tops[i] - base_z;
    const float ahead = dx * form.across[0] + dy * form.across[1] + dz * form.across[2];
    const float share = 1 - positive(1 - positive(ahead));
    const float nx = dx - share * form.travel[0];
    const float ny = dy - share * form.travel[1];
    const float nz = dz - share * form.travel[2];
    const float n_travel = nx * form.travel[0] + ny * form.travel[1] + nz * form.travel[2];
    const float square = nx * nx + ny * ny + nz * nz;
    const float beyond = square + share * n_travel - positive(n_travel) - form.rounding * std::sqrt(square);
    clearances[i] = beyond - kHuge * positive(nz);
  }
}

/// The same for a cylinder that does not point down: what is below its lower end, or beside it and not above its axis.
ISOCNC_VECTOR_CLONES void SweptPiece::clear_cylinder(double x, double step, double y, int count, const float* tops,
                                                     float* clearances) const {
  const FloatForm form = floats_;
  const auto [first, spacing, dy, base_z] = floats_from_base(x, step, y);
  const float drop = positive(-form.rise) + form.rounding;
  for (int i = 0; i < count; ++i) {
    const float dx = first + static_cast<float>(i) * spacing;
    const float dz = tops[i] - base_z;
    const float along = dx * form.axis[0] + dy * form.axis[1] + dz * form.axis[2];
    const float ahead = dx * form.across[0] + dy * form.across[1] + dz * form.across[2];
    const float share = 1 - positive(1 - positive(ahead));
    const float height = along - share * form.rise;
    const float nx = dx - share * form.travel[0] - height * form.axis[0];
    const float ny = dy - share * form.travel[1] - height * form.axis[1];
    const float nz = dz - share * form.travel[2] - height * form.axis[2];
    const float n_travel = nx * form.travel[0] + ny * form.travel[1] + nz * form.travel[2];
    const float square = nx * nx + ny * ny + nz * nz;
    const float beside = square + share * n_travel - positive(n_travel) -
                         (form.low_radius + form.rounding) * std::sqrt(square) - kHuge * positive(nz);
    const float below = -along - drop;
    clearances[i] = below + positive(beside - below);
  }
}

void SweptPiece::clear(double x, double step, double y, int count, const float* tops, float* clearances) const {
  if (ball_)
    clear_ball(x, step, y, count, tops, clearances);
  else if (is_cylinder_)
    clear_cylinder(x, step, y, count, tops, clearances);
  else
    clear_core(x, step, y, count, tops, clearances);
}

void SweptPiece::find_floats() {
  const Frustum& core = piece_.core;
  FloatForm& form = floats_;
  form.rise = static_cast<float>(travel_.dot(from_.axis));
  Vec3 across = ball_ ? travel_ : travel_ - travel_.dot(from_.axis) * from_.axis;
  const double square = across.squaredNorm();
  across = square > 0 ? Vec3(across / square) : Vec3(Vec3::Zero());
  for (int i = 0; i < 3; ++i) {
    form.axis[static_cast<std::size_t>(i)] = static_cast<float>(from_.axis[i]);
    form.travel[static_cast<std::size_t>(i)] = static_cast<float>(travel_[i]);
    form.across[static_cast<std::size_t>(i)] = static_cast<float>(across[i]);
  }
  const double height = core.top - core.bottom;
  form.height = static_cast<float>(height);
  form.low_radius = static_cast<float>(core.bottom_radius);
  form.high_radius = static_cast<float>(core.top_radius);
  form.growth = height > 0 ? static_cast<float>((core.top_radius - core.bottom_radius) / height) : 0.0F;
  is_cylinder_ = piece_.rounding == 0 && core.bottom_radius == core.top_radius && from_.axis.z() >= 0;
  const double size = height + std::max(core.bottom_radius, core.top_radius) + piece_.rounding + travel_.norm();
  form.rounding = static_cast<float>(piece_.rounding + kFloatError * size + kHeightError * std::abs(base_.z()));
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
  if (ball_) return ball_->of(line);
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

bool SweptPiece::contains(const Vec3& point) const { return out_of_core(point).norm() <= piece_.rounding + kConverged; }

static constexpr float kNothing = -std::numeric_limits<float>::infinity();
static constexpr float kAboveAll = -kNothing;

/// The greatest way from material of a vertical line, along the axis towards the tip, out of the sweep, mm, at most
/// `most`; 0 if it is not above `least`. Where the material ends at a pass before this one that was parallel to it, no
/// point is deeper in the sweep than the two passes are apart; on the line itself, at the side of a ball, may be as
/// much as the wall is high.
static double depth_along_axis(std::span<const SweptPiece> pieces, const Vec2& line,
                               std::span<const HeightInterval> material, double least, double most) {
  constexpr int kPoints = 8;
  constexpr int kHalvings = 12;
  constexpr double kBelowEnd = 0.995;
  const Vec3 axis = pieces.front().axis();
  const auto is_in = [&](double height, double way) {
    const Vec3 point = Vec3(line.x(), line.y(), height) - way * axis;
    return std::any_of(pieces.begin(), pieces.end(), [&](const SweptPiece& piece) { return piece.contains(point); });
  };
  double deepest = least;
  for (const HeightInterval& z : material)
    for (int i = 1; i <= kPoints && deepest < most; ++i) {
      // At the upper end itself the side of the body, which earlier passes share, would seem to be as deep as it is
      // long.
      const double share = std::min(static_cast<double>(i) / kPoints, kBelowEnd);
      const double height = z.bottom + (z.top - z.bottom) * share;
      if (!is_in(height, deepest)) continue;
      double out = most;
      if (is_in(height, most)) deepest = most;
      for (int halving = 0; halving < kHalvings && deepest < most; ++halving) {
        const double middle = (deepest + out) / 2;
        (is_in(height, middle) ? deepest : out) = middle;
      }
    }
  return deepest > least ? deepest : 0;
}

void sweep(std::span<const SweptPiece> pieces, DexelSink& sink) {
  if (pieces.empty()) return;
  const DexelGrid& grid = sink.grid();
  const double rise = std::abs(pieces.front().axis().z());
  struct Window {
    const SweptPiece* piece;
    int first_row, last_row, first, last;
    bool is_in_row = false;
  };
  std::vector<Window> windows;
  int first_row = grid.rows;
  int last_row = 0;
  for (const SweptPiece& piece : pieces) {
    const solids::BoundingBox& box = piece.bounds();
    if (!sink.has_material_in({box.min().z(), box.max().z()})) continue;
    const Window window{&piece, grid.first_row(box.min().y()), grid.first_row(box.max().y()),
                        grid.first_column(box.min().x()), grid.first_column(box.max().x())};
    if (window.first_row >= window.last_row || window.first >= window.last) continue;
    windows.push_back(window);
    first_row = std::min(first_row, window.first_row);
    last_row = std::max(last_row, window.last_row);
  }
  // What a cut must be deeper than, mm, so that its depth along the axis is looked for.
  const auto least_depth = [&] {
    return std::max(sink.depth_limit(), static_cast<double>(sink.count().inside.depth) * rise);
  };
  std::vector<HeightInterval> met;
  // `material_top` is the highest end of the dexel's material.
  const auto take = [&](int row, int column, double material_top) {
    const Vec2 line(grid.x(column), grid.y(row));
    met.clear();
    for (const Window& window : windows) {
      if (!window.is_in_row || column < window.first || column >= window.last) continue;
      const HeightInterval interval = window.piece->chord(line);
      if (!interval.is_empty()) met.push_back(interval);
    }
    if (met.empty()) return HeightInterval();
    if (met.size() > 1)
      std::sort(met.begin(), met.end(),
                [](const HeightInterval& left, const HeightInterval& right) { return left.bottom < right.bottom; });
    sink.set_share(1);
    HeightInterval whole = met.front();
    for (const HeightInterval& each : met) whole.include(each);
    const double least = least_depth();
    if ((std::min(whole.top, material_top) - whole.bottom) * rise > least) {
      const std::vector<HeightInterval> material = sink.material(row, column, whole);
      double length = 0;
      for (const HeightInterval& each : material) length += each.top - each.bottom;
      const double most = length * rise;
      if (most > least) sink.set_share(depth_along_axis(pieces, line, material, least, most) / most);
    }
    HeightInterval present = met.front();
    for (const HeightInterval& next : met) {
      if (next.bottom > present.top + kNoSkin) {
        sink.take_apart(row, column, present);
        present = next;
      }
      present.include(next);
    }
    return present;
  };
  // Of a row, from the first of its dexels on that the sweep may meet, in whole groups.
  using RowFloats = std::array<float, static_cast<std::size_t>(Tile::kSize) + kTogether>;
  RowFloats tops;
  RowFloats clearances;
  const auto whole_groups = [](int size) { return (size + kTogether - 1) / kTogether * kTogether; };
  // Sets `tops`, and the least of the clearances of all pieces that have a part in these dexels.
  const auto look_at_row = [&](int row, int first, int last) {
    const int size = last - first;
    const int whole = whole_groups(size);
    sink.highest(row, first, size, tops.data());
    std::fill(tops.begin() + size, tops.begin() + whole, kNothing);
    const auto clear = [&](const Window& window, int begin, int end, float* result) {
      window.piece->clear(grid.x(first + begin), grid.spacing.x(), grid.y(row), end - begin, tops.data() + begin,
                          result);
    };
    if (windows.size() == 1) return clear(windows.front(), 0, whole, clearances.data());
    std::fill_n(clearances.begin(), whole, 1.0F);
    RowFloats each;
    for (const Window& window : windows) {
      if (!window.is_in_row) continue;
      const int begin = (window.first - first) / kTogether * kTogether;
      const int end = std::min(whole, whole_groups(window.last - first));
      clear(window, begin, end, each.data());
      float* const least = clearances.data() + begin;
      for (int i = 0; i < end - begin; ++i)
        least[i] = each[static_cast<std::size_t>(i)] < least[i] ? each[static_cast<std::size_t>(i)] : least[i];
    }
  };
  // Whether the sweep may meet material in a group. In a loop that becomes vectors.
  const auto is_open = [&](std::size_t at) {
    unsigned open = 0;
    for (std::size_t i = at; i < at + kTogether; ++i)
      open |= static_cast<unsigned>(!(clearances[i] > 0)) & static_cast<unsigned>(tops[i] > kNothing);
    return open != 0;
  };
  // Many dexels of a ball are cut by each of its short ways: their chords are computed together.
  const chords::CapsuleChord* const ball = windows.size() == 1 && sink.cuts() ? windows.front().piece->ball() : nullptr;
  // Takes a group of dexels, those from the `at`-th one of the row on.
  const auto take_ball = [&](int row, int first, std::size_t at, int size) {
    std::array<float, kTogether> bottoms, ends;
    const int group = first + static_cast<int>(at);
    ball->of_row(grid.x(group), grid.spacing.x(), grid.y(row), kTogether, bottoms.data(), ends.data());
    const double least = least_depth();
    const auto is_deep = [&](float depth) { return static_cast<double>(depth) * rise > least; };
    const auto depth_at = [&](std::size_t i) { return std::min(ends[i], tops[at + i]) - bottoms[i]; };
    float deepest = 0;
    for (std::size_t i = 0; i < kTogether; ++i) {
      if (clearances[at + i] > 0) bottoms[i] = kAboveAll;
      deepest = std::max(deepest, depth_at(i));
    }
    sink.set_share(1);
    if (!is_deep(deepest)) {
      std::copy_n(bottoms.begin(), kTogether, sink.bottoms());
      std::copy_n(ends.begin(), kTogether, sink.tops());
      return sink.take_row(row, group, group + size);
    }
    for (int i = 0; i < size; ++i) {
      const auto lane = static_cast<std::size_t>(i);
      if (is_deep(depth_at(lane))) {
        sink.set(0, take(row, group + i, static_cast<double>(tops[at + lane])));
      } else {
        sink.set_share(1);
        sink.bottoms()[0] = bottoms[lane];
        sink.tops()[0] = ends[lane];
      }
      sink.take_row(row, group + i, group + i + 1);
    }
  };
  // Rows from the `from`-th one on, each `step`-th one; in a group of dexels, `most` of them.
  const auto take_rows = [&](int from, int step, int most) {
    for (int row = from; row < last_row; row += step) {
      int first = grid.columns;
      int last = 0;
      for (Window& window : windows) {
        window.is_in_row = row >= window.first_row && row < window.last_row;
        if (!window.is_in_row) continue;
        const HeightInterval shadow = window.piece->shadow(grid.y(row));
        window.first = grid.first_column(shadow.bottom);
        window.last = grid.first_column(shadow.top);
        window.is_in_row = window.first < window.last;
        if (!window.is_in_row) continue;
        first = std::min(first, window.first);
        last = std::max(last, window.last);
      }
      if (first >= last) continue;
      look_at_row(row, first, last);
      for (int group = first; group < last; group += kTogether) {
        const int size = std::min(kTogether, last - group);
        const auto at = static_cast<std::size_t>(group - first);
        if (!is_open(at)) continue;
        if (ball) {
          take_ball(row, first, at, size);
          continue;
        }
        int taken = 0;
        for (int i = 0; i < size && taken < most; ++i) {
          const std::size_t lane = at + static_cast<std::size_t>(i);
          if (clearances[lane] > 0 || !(tops[lane] > kNothing)) continue;
          ++taken;
          sink.set(0, take(row, group + i, static_cast<double>(tops[lane])));
          sink.take_row(row, group + i, group + i + 1);
        }
      }
    }
  };
  if (sink.only_finds()) {
    take_rows(first_row, kTogether, 1);
    if (static_cast<double>(sink.count().all.depth) > kDeep) return;
  }
  take_rows(first_row, 1, kTogether);
}

}  // namespace isocnc::stock
