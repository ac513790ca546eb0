#include "interpreter/stock/unit_sweep.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "interpreter/solids/clearance.h"

namespace isocnc::stock {

using geometry::Helix;
using geometry::Vec2;
using geometry::Vec3;
using solids::AxisPlacement;
using solids::BodyPiece;
using solids::BoundingBox;
using solids::Frustum;

namespace {

constexpr double kDepthTolerance = 0.001;  ///< Deviation of a chord where it changes the depth, mm.
constexpr double kAskMargin = 0.001;       ///< Bodies that ask are thinner by this, mm.
constexpr double kVerticalSine = 1e-9;     ///< An axis that is tilted by less counts as vertical.
constexpr double kMaxParts = 100000;       ///< Of one sweep.

bool is_usable(const Vec3& point) { return point.allFinite() && point.cwiseAbs().maxCoeff() <= solids::kMaxCoordinate; }

bool is_usable(const AxisPlacement& at) {
  return is_usable(at.origin) && at.axis.allFinite() && std::abs(at.axis.squaredNorm() - 1) < 1e-6;
}

bool is_usable(const StraightPath& path) { return is_usable(path.from) && is_usable(path.to); }

bool is_usable(const HelixPath& path) {
  const Helix& helix = path.helix;
  return is_usable(AxisPlacement{helix.center, path.axis}) && is_usable(helix.out) && is_usable(helix.side) &&
         is_usable(helix.rise) && helix.sweep > 0 && helix.sweep <= 1000 * std::numbers::pi;
}

bool is_usable(const TurningPath& path) { return is_usable(path.from) && is_usable(path.to); }

bool is_vertical(const Vec3& axis) { return axis.head<2>().norm() < kVerticalSine; }

int parts_of(double parts) { return static_cast<int>(std::clamp(std::ceil(parts), 1.0, kMaxParts)); }

Vec3 point_of(const Helix& helix, double angle) {
  return helix.center + std::cos(angle) * helix.out + std::sin(angle) * helix.side + angle / helix.sweep * helix.rise;
}

/// The part of a frustum between two heights, as far as it goes.
Frustum slab(const Frustum& core, double bottom, double top) {
  const double height = core.top - core.bottom;
  const auto radius_at = [&](double z) {
    const double share = height > 0 ? (z - core.bottom) / height : 0.0;
    return core.bottom_radius + share * (core.top_radius - core.bottom_radius);
  };
  bottom = std::max(bottom, core.bottom);
  top = std::min(top, core.top);
  return {bottom, radius_at(bottom), top, radius_at(top)};
}

SweptShape shape_of_body(const solids::RevolvedBody& body, SweepPurpose purpose) {
  const double margin = purpose == SweepPurpose::Cut ? 0 : kAskMargin;
  SweptShape shape{.columns = chords::columns_of(body, false, margin),
                   .turned_over = chords::columns_of(body, true, margin),
                   .body_pieces = body.pieces().size(),
                   .radius = body.maximum_radius(),
                   .bottom = body.bottom(),
                   .top = body.top()};
  for (const BodyPiece& piece : body.pieces()) shape.pieces.push_back(chords::shrunk(piece, margin));
  for (std::size_t i = 0; i < shape.body_pieces; ++i) {
    const Frustum core = shape.pieces[i].core;
    shape.pieces.push_back({.core = slab(core, core.bottom, core.bottom + core.bottom_radius)});
    shape.pieces.push_back({.core = slab(core, core.top - core.top_radius, core.top)});
  }
  return shape;
}

/// The largest z along the axis of a body, on its way between two placements, at which a point at most `radius` from
/// the axis may be below `top`; infinite where the axis is nearly level.
double highest_below(double top, const AxisPlacement& from, const AxisPlacement& to, double radius) {
  const double up = std::min(from.axis.z(), to.axis.z());
  if (up < 0.1) return std::numeric_limits<double>::infinity();
  const double over = top + radius - std::min(from.origin.z(), to.origin.z());
  return over / (over > 0 ? up : 1.0);
}

/// The axis on the way from one direction to another.
class AxisTurn {
 public:
  AxisTurn(const Vec3& from, const Vec3& to) : from_(from) {
    const Vec3 across = to - to.dot(from) * from;
    const double sine = across.norm();
    angle_ = std::atan2(sine, to.dot(from));
    aside_ = sine > 0 ? Vec3(across / sine) : Vec3(Vec3::Zero());
  }
  double angle() const { return angle_; }
  Vec3 at(double share) const { return std::cos(share * angle_) * from_ + std::sin(share * angle_) * aside_; }

 private:
  Vec3 from_;
  Vec3 aside_;
  double angle_;
};

}  // namespace

SweptShapes::SweptShapes(std::span<const Sweep> sweeps) {
  std::pair<const solids::RevolvedBody*, SweepPurpose> last = {nullptr, SweepPurpose::Cut};
  for (const Sweep& sweep : sweeps) {
    if (!sweep.body || last == std::pair(sweep.body, sweep.purpose)) continue;
    last = {sweep.body, sweep.purpose};
    const auto index = static_cast<std::uint32_t>(shapes_.size());
    if (indexes_.try_emplace(last, index).second) shapes_.push_back(shape_of_body(*sweep.body, sweep.purpose));
  }
}

SweepDivider::SweepDivider(const SweptShapes& shapes, double spacing, double top)
    : shapes_(shapes), tolerance_(spacing / 20), top_(top) {}

void SweepDivider::append(const Sweep& sweep, std::uint32_t index) {
  if (!sweep.body || !std::visit([](const auto& path) { return is_usable(path); }, sweep.path)) return;
  sweep_ = index;
  piece_ = 0;
  if (last_body_ != std::pair(sweep.body, sweep.purpose)) {
    last_body_ = {sweep.body, sweep.purpose};
    shape_ = shapes_.index_of(*sweep.body, sweep.purpose);
  }
  std::visit([&](const auto& path) { append(path); }, sweep.path);
}

void SweepDivider::append(const StraightPath& path) { append_line(path.from.origin, path.to, path.from.axis); }

void SweepDivider::append_line(const Vec3& from, const Vec3& to, const Vec3& axis) {
  if (!is_vertical(axis)) return append_slanted({from, axis}, to - from, 0, shape().body_pieces);
  append_upright(UprightLine{from, to}, axis.z() < 0, {from.cwiseMin(to), from.cwiseMax(to)});
}

void SweepDivider::append_upright(const std::variant<UprightLine, LevelArc, SlantedLine>& motion, bool is_upside_down,
                                  const BoundingBox& path) {
  const SweptShape& body = shape();
  const double bottom = is_upside_down ? -body.top : body.bottom;
  const double top = is_upside_down ? -body.bottom : body.top;
  units_.push_back({.sweep = sweep_,
                    .shape = shape_,
                    .is_upside_down = is_upside_down,
                    .motion = motion,
                    .bounds = {path.min() + Vec3(-body.radius, -body.radius, bottom),
                               path.max() + Vec3(body.radius, body.radius, top)}});
}

void SweepDivider::append_slanted(const AxisPlacement& from, const Vec3& travel, std::size_t first_piece,
                                  std::size_t piece_count) {
  UnitSweep unit{
      .sweep = sweep_, .shape = shape_, .piece = piece_, .motion = SlantedLine{from, travel, first_piece, piece_count}};
  for (std::size_t i = 0; i < piece_count; ++i)
    unit.bounds.extend(swept_bounds(shape().pieces[first_piece + i], from, travel));
  units_.push_back(unit);
}

void SweepDivider::append(const HelixPath& path) {
  const Helix& helix = path.helix;
  const double level = std::max({std::abs(helix.out.z()), std::abs(helix.side.z()), helix.rise.norm()});
  if (is_vertical(path.axis) && level < 1e-9) return append_level(helix, path.axis.z() < 0);
  append_chords(helix, path.axis);
}

/// In parts of at most half a turn.
void SweepDivider::append_level(const Helix& helix, bool is_upside_down) {
  const double turn = std::min(helix.sweep, 2 * std::numbers::pi);
  const int parts = turn <= 3.1 ? 1 : 3;
  const bool is_counterclockwise = helix.out.cross(helix.side).z() > 0;
  const auto from_center = [&](int part) {
    const double angle = turn * part / parts;
    return Vec2((std::cos(angle) * helix.out + std::sin(angle) * helix.side).head<2>());
  };
  const double radius = helix.out.norm();
  const Vec3 reach(radius, radius, 0);
  for (int part = 0; part < parts; ++part) {
    LevelArc arc{.center = helix.center.head<2>(),
                 .start = from_center(part),
                 .end = from_center(part + 1),
                 .radius = radius,
                 .z = helix.center.z()};
    if (!is_counterclockwise) std::swap(arc.start, arc.end);
    append_upright(arc, is_upside_down, {helix.center - reach, helix.center + reach});
  }
}

/// A chord deviates by radius angle^2 / 8. Where the circle is level and the axis vertical, only walls deviate.
void SweepDivider::append_chords(const Helix& helix, const Vec3& axis) {
  const bool is_level = std::abs(helix.out.z()) + std::abs(helix.side.z()) < 1e-9 && is_vertical(axis);
  const double tolerance = is_level ? std::max(kDepthTolerance, tolerance_ / 5) : kDepthTolerance;
  const double radius = std::max(helix.out.norm(), helix.side.norm());
  const int parts = parts_of(helix.sweep / std::sqrt(8 * tolerance / std::max(radius, tolerance)));
  Vec3 from = point_of(helix, 0);
  for (int part = 1; part <= parts; ++part) {
    const Vec3 to = point_of(helix, helix.sweep * part / parts);
    append_line(from, to, axis);
    from = to;
  }
}

void SweepDivider::append(const TurningPath& path) {
  const AxisTurn turn(path.from.axis, path.to.axis);
  if (turn.angle() * solids::kMaxCoordinate < 1e-3)
    return append_line(path.from.origin, path.to.origin, path.from.axis);
  const std::size_t count = shape().body_pieces;
  for (std::size_t piece = 0; piece < count; ++piece) append_turn(path, piece);
}

/// A piece either stands at poses, or moves along short straight lines with the axis at rest.
///
/// - Poses at the distance d leave cusps of d^2 / (8 r) on a surface of the radius r: at most the tolerance, a 20th of
///   the spacing. At the sharp rims of a frustum cusps would be as high as d / 2, so between the poses both of its ends
///   move along short straight lines.
/// - A straight motion whose axis stands as in its middle deviates by half the angle times the distance from the middle
///   of the piece, at most half the tolerance, and its chord by at most a quarter.
void SweepDivider::append_turn(const TurningPath& path, std::size_t piece_index) {
  piece_ = static_cast<std::uint32_t>(piece_index);
  const AxisTurn turn(path.from.axis, path.to.axis);
  const BodyPiece piece = shape().pieces[piece_index];
  const double widest = std::max(piece.core.bottom_radius, piece.core.top_radius) + piece.rounding;
  const double highest = piece.rounding + highest_below(top_, path.from, path.to, widest);
  if (highest < piece.core.bottom) return;
  // Deviations above all material do not matter.
  const Frustum core = slab(piece.core, piece.core.bottom, highest);
  const Vec3 shift = path.to.origin - path.from.origin;
  const auto at = [&](double share) { return AxisPlacement{path.from.origin + share * shift, turn.at(share)}; };
  // The path of a point on the axis deviates from its chord by the angle's square times its height, over 8.
  const auto arc_parts = [&](double z) { return turn.angle() * std::sqrt(std::abs(z) / (2 * tolerance_)); };
  const auto append_straight = [&](double z, int parts, std::size_t index) {
    Vec3 first = path.from.at(z);
    for (int part = 0; part < parts; ++part) {
      const Vec3 last = at(static_cast<double>(part + 1) / parts).at(z);
      const Vec3 axis = turn.at((part + 0.5) / parts);
      append_slanted({first - z * axis, axis}, last - first, index, 1);
      first = last;
    }
  };
  const auto straight_parts_of = [&](const Frustum& part) {
    const double half_size = std::hypot((part.top - part.bottom) / 2, std::max(part.bottom_radius, part.top_radius));
    return parts_of(std::max(turn.angle() * half_size / tolerance_, arc_parts((part.bottom + part.top) / 2)));
  };
  const int straight_parts = straight_parts_of(core);
  const double radius = piece.rounding > 0 ? piece.rounding : std::min(core.bottom_radius, core.top_radius);
  const double reach = std::max(std::hypot(core.bottom, core.bottom_radius), std::hypot(core.top, core.top_radius));
  const double length = shift.norm() + turn.angle() * (reach + piece.rounding);
  const int poses =
      radius > 0 ? parts_of(length / std::min(radius, std::sqrt(8 * radius * tolerance_))) : parts_of(kMaxParts);
  const bool is_ball = core.bottom == core.top && core.bottom_radius == 0 && core.top_radius == 0;
  if (is_ball || straight_parts <= 2 + poses / 4)
    return append_straight((core.bottom + core.top) / 2, straight_parts, piece_index);
  for (int pose = 0; pose <= poses; ++pose)
    append_slanted(at(static_cast<double>(pose) / poses), Vec3::Zero(), piece_index, 1);
  if (piece.rounding > 0) return;
  for (const std::size_t end : {0U, 1U}) {
    const std::size_t index = shape().body_pieces + 2 * piece_index + end;
    const Frustum part = shape().pieces[index].core;
    if (part.bottom > highest) continue;
    append_straight((part.bottom + part.top) / 2, straight_parts_of(part), index);
  }
}

/// Sweeps that one thread divides at once.
static constexpr std::size_t kPart = 512;

UnitSweeps::UnitSweeps(std::span<const Sweep> sweeps, double spacing, double top, const Workers& workers)
    : shapes_(sweeps), parts_((sweeps.size() + kPart - 1) / kPart, SweepDivider(shapes_, spacing, top)) {
  for_each_number(workers, parts_.size(), [&](std::size_t part) {
    const std::size_t end = std::min(sweeps.size(), (part + 1) * kPart);
    for (std::size_t i = part * kPart; i < end; ++i) parts_[part].append(sweeps[i], static_cast<std::uint32_t>(i));
  });
  for (const SweepDivider& part : parts_)
    for (const UnitSweep& unit : part.units()) units_.push_back(&unit);
}

void UnitSweeps::apply(const UnitSweep& unit, const UnitSweep* before, DexelSink& sink) const {
  const SweptShape& shape = shapes_[unit.shape];
  const auto& columns = unit.is_upside_down ? shape.turned_over : shape.columns;
  if (const auto* line = std::get_if<UprightLine>(&unit.motion)) {
    const bool is_same = before && before->shape == unit.shape && before->is_upside_down == unit.is_upside_down;
    const auto* line_before = is_same ? std::get_if<UprightLine>(&before->motion) : nullptr;
    for (const RevolvedColumn& column : columns) sweep(column, *line, line_before, sink);
  } else if (const auto* arc = std::get_if<LevelArc>(&unit.motion)) {
    for (const RevolvedColumn& column : columns) sweep(column, *arc, sink);
  } else {
    const SlantedLine& slanted = std::get<SlantedLine>(unit.motion);
    std::vector<SweptPiece> pieces;
    for (std::size_t i = 0; i < slanted.piece_count; ++i)
      pieces.emplace_back(shape.pieces[slanted.first_piece + i], slanted.from, slanted.travel, sink.ceiling());
    sweep(pieces, sink);
  }
}

}  // namespace isocnc::stock
