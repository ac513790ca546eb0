#include "interpreter/solids/tool_shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

namespace isocnc::solids {

using ShapeKind = ShapeProblem::Kind;
using MaybeProblem = std::optional<ShapeProblem>;

namespace {

enum class Zero : std::uint8_t { Allowed, Refused };

MaybeProblem problem_of(double found, ShapeValue value, Zero zero, std::size_t row = 0) {
  const auto problem = [&](ShapeKind kind, double limit) {
    return ShapeProblem{.kind = kind, .value = value, .row = row, .found = found, .limit = limit};
  };
  if (!std::isfinite(found)) return problem(ShapeKind::NotFinite, 0);
  if (zero == Zero::Refused && found <= 0) return problem(ShapeKind::NotPositive, 0);
  if (found < 0) return problem(ShapeKind::Negative, 0);
  if (found > kMaxSize) return problem(ShapeKind::TooLarge, kMaxSize);
  return {};
}

MaybeProblem too_large(double found, ShapeValue value, double limit) {
  if (found <= limit) return {};
  return ShapeProblem{.kind = ShapeKind::TooLarge, .value = value, .found = found, .limit = limit};
}

MaybeProblem too_short(double length, double limit) {
  if (length >= limit) return {};
  return ShapeProblem{.kind = ShapeKind::TooSmall, .value = ShapeValue::Length, .found = length, .limit = limit};
}

MaybeProblem problem_of_angle(double angle) {
  MaybeProblem problem = problem_of(angle, ShapeValue::TipAngle, Zero::Refused);
  if (!problem && angle >= 180)
    problem = {.kind = ShapeKind::TooLarge, .value = ShapeValue::TipAngle, .found = angle, .limit = 180};
  return problem;
}

MaybeProblem problem_of_count(std::size_t count, std::size_t minimum) {
  const auto problem = [&](ShapeKind kind, std::size_t limit) {
    return ShapeProblem{.kind = kind,
                        .value = ShapeValue::Points,
                        .found = static_cast<double>(count),
                        .limit = static_cast<double>(limit)};
  };
  if (count < minimum) return problem(ShapeKind::TooFew, minimum);
  if (count > kMaxShapePoints) return problem(ShapeKind::TooMany, kMaxShapePoints);
  return {};
}

/// The first of some problems.
MaybeProblem first_of(std::initializer_list<MaybeProblem> problems) {
  for (const MaybeProblem& problem : problems)
    if (problem) return problem;
  return {};
}

BodyPiece cylinder(double radius, double from, double to) { return {.core = {from, radius, to, radius}}; }

double cone_height(double tip_radius, double radius, double tip_angle) {
  return (radius - tip_radius) / std::tan(tip_angle / 2 * std::numbers::pi / 180);
}

}  // namespace

BodyOrProblem flat_body(double radius, double length) { return bull_body(radius, 0, length); }

BodyOrProblem ball_body(double radius, double length) { return bull_body(radius, radius, length); }

BodyOrProblem bull_body(double radius, double corner_radius, double length) {
  const MaybeProblem problem =
      first_of({problem_of(radius, ShapeValue::Radius, Zero::Refused),
                problem_of(corner_radius, ShapeValue::CornerRadius, Zero::Allowed),
                too_large(corner_radius, ShapeValue::CornerRadius, radius),
                problem_of(length, ShapeValue::Length, Zero::Refused), too_short(length, 2 * corner_radius)});
  if (problem) return *problem;
  std::vector<BodyPiece> pieces;
  const double flat = radius - corner_radius;
  if (corner_radius > 0)
    pieces.push_back({.core = {corner_radius, flat, corner_radius, flat}, .rounding = corner_radius});
  pieces.push_back(cylinder(radius, corner_radius, length));
  return RevolvedBody(std::move(pieces));
}

BodyOrProblem cone_body(double radius, double tip_radius, double tip_angle, double length) {
  const MaybeProblem problem =
      first_of({problem_of(radius, ShapeValue::Radius, Zero::Refused),
                problem_of(tip_radius, ShapeValue::TipRadius, Zero::Allowed),
                too_large(tip_radius, ShapeValue::TipRadius, radius), problem_of_angle(tip_angle),
                problem_of(length, ShapeValue::Length, Zero::Refused)});
  if (problem) return *problem;
  const double height = cone_height(tip_radius, radius, tip_angle);
  if (height >= length) {
    const double top_radius = tip_radius + (radius - tip_radius) * (length / height);
    return RevolvedBody({{.core = {0, tip_radius, length, top_radius}}});
  }
  std::vector<BodyPiece> pieces;
  if (height > 0) pieces.push_back({.core = {0, tip_radius, height, radius}});
  pieces.push_back(cylinder(radius, height, length));
  return RevolvedBody(std::move(pieces));
}

BodyOrProblem drill_body(double radius, double tip_angle, double length) {
  MaybeProblem problem = first_of({problem_of(radius, ShapeValue::Radius, Zero::Refused), problem_of_angle(tip_angle),
                                   problem_of(length, ShapeValue::Length, Zero::Refused)});
  if (!problem) problem = too_short(length, cone_height(0, radius, tip_angle));
  if (problem) return *problem;
  return cone_body(radius, 0, tip_angle, length);
}

BodyOrProblem disc_body(double radius, double thickness) {
  const MaybeProblem problem = first_of({problem_of(radius, ShapeValue::Radius, Zero::Refused),
                                         problem_of(thickness, ShapeValue::Thickness, Zero::Refused)});
  if (problem) return *problem;
  return RevolvedBody({cylinder(radius, 0, thickness)});
}

namespace {

/// Of a form's point, after the one before it. z may be negative, as for what stands out below a reference.
MaybeProblem problem_of_point(std::span<const FormPoint> points, std::size_t row) {
  const FormPoint& point = points[row];
  MaybeProblem problem = problem_of(std::abs(point.z), ShapeValue::Z, Zero::Allowed, row);
  if (problem) {
    problem->found = point.z;
    return problem;
  }
  if (row > 0 && point.z < points[row - 1].z)
    return ShapeProblem{.kind = ShapeKind::NotAscending,
                        .value = ShapeValue::Z,
                        .row = row,
                        .found = point.z,
                        .limit = points[row - 1].z};
  return problem_of(point.radius, ShapeValue::PointRadius, Zero::Allowed, row);
}

/// Whether the step up to a point is a face of the frustum below or above it. Otherwise it is a disc of no thickness.
bool is_part_of_neighbors(std::span<const FormPoint> points, std::size_t step) {
  const FormPoint& low = points[step - 1];
  const FormPoint& high = points[step];
  const bool is_of_below = step >= 2 && points[step - 2].z < low.z && low.radius >= high.radius;
  const bool is_of_above = step + 1 < points.size() && points[step + 1].z > high.z && high.radius >= low.radius;
  return is_of_below || is_of_above;
}

/// The frustums between neighboring points, and the discs that stand out from them.
std::vector<BodyPiece> pieces_between(std::span<const FormPoint> points) {
  std::vector<BodyPiece> pieces;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const FormPoint& low = points[i - 1];
    const FormPoint& high = points[i];
    if (low.radius + high.radius == 0) continue;
    const bool is_step = high.z == low.z;
    const bool is_covered = is_step && is_part_of_neighbors(points, i);
    if (!is_covered) pieces.push_back({.core = {low.z, low.radius, high.z, high.radius}});
  }
  return pieces;
}

}  // namespace

BodyOrProblem form_body(std::span<const FormPoint> points) {
  if (const MaybeProblem problem = problem_of_count(points.size(), 2)) return *problem;
  for (std::size_t row = 0; row < points.size(); ++row)
    if (const MaybeProblem problem = problem_of_point(points, row)) return *problem;
  std::vector<BodyPiece> pieces = pieces_between(points);
  const auto has_height = [](const BodyPiece& piece) { return piece.core.top > piece.core.bottom; };
  if (std::none_of(pieces.begin(), pieces.end(), has_height))
    return ShapeProblem{.kind = ShapeKind::WithoutVolume, .value = ShapeValue::Points};
  return RevolvedBody(std::move(pieces));
}

BodyOrProblem stacked_body(std::span<const StackRow> rows, double base) {
  MaybeProblem problem = problem_of(std::abs(base), ShapeValue::Z, Zero::Allowed);
  if (problem) problem->found = base;
  if (!problem) problem = problem_of_count(rows.size(), 1);
  if (problem) return *problem;
  std::vector<FormPoint> points;
  double z = base;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    problem = first_of({problem_of(rows[row].height, ShapeValue::Height, Zero::Refused, row),
                        problem_of(rows[row].lower_diameter, ShapeValue::LowerDiameter, Zero::Allowed, row),
                        problem_of(rows[row].upper_diameter, ShapeValue::UpperDiameter, Zero::Allowed, row)});
    if (problem) return *problem;
    points.push_back({z, rows[row].lower_diameter / 2});
    z += rows[row].height;
    points.push_back({z, rows[row].upper_diameter / 2});
  }
  std::vector<BodyPiece> pieces = pieces_between(points);
  if (pieces.empty()) return ShapeProblem{.kind = ShapeKind::WithoutVolume, .value = ShapeValue::Points};
  return RevolvedBody(std::move(pieces));
}

}  // namespace isocnc::solids
