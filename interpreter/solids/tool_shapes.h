#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>

#include "interpreter/solids/revolved_body.h"

namespace isocnc::solids {

/// A value that describes a body, so that a message can point at it.
enum class ShapeValue : std::uint8_t {
  Length,
  Radius,
  CornerRadius,
  TipRadius,
  TipAngle,
  Thickness,
  Z,              ///< First number of a form's point, or where a stack begins.
  PointRadius,    ///< Second number of a form's point.
  Height,         ///< First number of a stack's row.
  LowerDiameter,  ///< Second number of a stack's row.
  UpperDiameter,  ///< Third number of a stack's row.
  Points,         ///< The list of points or rows itself.
};

/// Why values describe no body. Users write such values, so a problem is an ordinary result.
struct ShapeProblem {
  enum class Kind : std::uint8_t {
    NotFinite,      ///< NaN or infinite.
    NotPositive,    ///< 0 or negative where only a positive value makes sense.
    Negative,       ///< Below 0.
    TooLarge,       ///< Above `limit`: kMaxSize, or another value of the same body, such as a corner above the radius.
    TooSmall,       ///< Below `limit`: a length that does not hold the tip or the corner.
    NotAscending,   ///< A z below that of the point before it, which is `limit`.
    TooFew,         ///< Fewer points than `limit`.
    TooMany,        ///< More points than `limit`.
    WithoutVolume,  ///< The points enclose no volume.
  };

  Kind kind = Kind::NotFinite;
  ShapeValue value = ShapeValue::Length;
  std::size_t row = 0;  ///< Index of the point or row.
  double found = 0;     ///< The value, or the number of points.
  double limit = 0;     ///< The limit that it violates.
};

using BodyOrProblem = std::variant<RevolvedBody, ShapeProblem>;

inline constexpr double kMaxSize = 1e5;              ///< Largest accepted size of a body, mm.
inline constexpr std::size_t kMaxShapePoints = 256;  ///< Largest accepted number of points or rows.

// Tools: the tip at z = 0, all of the body up to z = `length`. Lengths and radii in mm, angles in degrees. The first
// problem wins, in the order of the parameters.

/// A cylinder: flat end mill, shank from the tip.
BodyOrProblem flat_body(double radius, double length);

/// A ball nose and a cylinder. `length` is at least twice the radius.
BodyOrProblem ball_body(double radius, double length);

/// A flat end with rounded edge and a cylinder. `corner_radius` is between 0 (flat) and the radius (ball), and `length`
/// at least twice as much.
BodyOrProblem bull_body(double radius, double corner_radius, double length);

/// A cone that opens by `tip_angle` (whole angle, above 0 and below 180) from `tip_radius`, at the tip, to `radius`,
/// and a cylinder: engraving, V and chamfering cutters. A length that ends within the cone ends the body there.
BodyOrProblem cone_body(double radius, double tip_radius, double tip_angle, double length);

/// A cone with a sharp tip and a cylinder. `length` holds at least the cone.
BodyOrProblem drill_body(double radius, double tip_angle, double length);

/// A disc with its own axis: a saw blade, a grooving cutter in an aggregate. z runs along that axis, from 0 at one face
/// to `thickness` at the other, whatever the direction of the spindle; the caller places the body accordingly.
BodyOrProblem disc_body(double radius, double thickness);

/// A point of a form's outline.
struct FormPoint {
  double z = 0;       ///< mm, nowhere below that of the point before.
  double radius = 0;  ///< mm, not negative.
};

/// A form by its outline: straight lines from point to point, closed by discs across both ends. Two points with the
/// same z are a step.
BodyOrProblem form_body(std::span<const FormPoint> points);

/// A row of a stack: a cylinder or cone on top of the row before it.
struct StackRow {
  double height = 0;          ///< mm, positive.
  double lower_diameter = 0;  ///< mm, not negative.
  double upper_diameter = 0;  ///< mm, not negative.
};

/// A stack of cylinders and cones from z = `base` up: a holder from the collet's face, a nose from the gauge line, a
/// shank from the end of the cutter.
BodyOrProblem stacked_body(std::span<const StackRow> rows, double base);

}  // namespace isocnc::solids
