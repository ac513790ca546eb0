#pragma once

#include <cstdint>
#include <optional>

namespace isocnc::geometry {

/// A point or offset in the arc's plane, mm: u along the plane's first axis, v along the second. The plane's normal is
/// u x v: i x j in G17, k x i in G18, j x k in G19 (D40).
struct PlanePoint {
  double u = 0;
  double v = 0;

  double norm() const;
  PlanePoint operator-(const PlanePoint& other) const { return {u - other.u, v - other.v}; }
  PlanePoint operator+(const PlanePoint& other) const { return {u + other.u, v + other.v}; }
};

/// What a program says of a circle. All offsets are from the arc's start, mm.
struct ArcGiven {
  PlanePoint end;
  std::optional<double> center_u;
  std::optional<double> center_v;
  std::optional<double> radius;
  bool counterclockwise = false;  ///< G03.
};

enum class ArcProblem : std::uint8_t {
  None,
  CenterUndeterminedByU,  ///< Only u of the center is given, and the ends do not differ in v (ISO048-053).
  CenterUndeterminedByV,
  CenterMismatch,  ///< The center is not equally far from both ends, or is the start itself (ISO031).
  RadiusMismatch,  ///< Radius and center contradict each other (ISO029).
  RadiusTooSmall,  ///< Not positive, or less than half the chord (ISO030).
};

/// A circle through both ends, or why there is none; then the two values found tell what is wrong.
struct Circle {
  ArcProblem problem = ArcProblem::None;
  PlanePoint center;          ///< From the start.
  double found = 0;           ///< Distance center-start, or the radius as written.
  double wanted = 0;          ///< Distance center-end, distance center-start, or half the chord.
  bool goes_nowhere = false;  ///< By radius alone with start and end equal: no sweep (D36).
};

/// Ends that differ by less count as equal (D35).
inline constexpr double kEqualCoordinate = 1e-6;

/// Finds the circle (I.3.4.3.a, D35 to D38); the first problem in the order of D45. `tolerance` in mm.
Circle find_circle(const ArcGiven& given, double tolerance);

/// Whether find_circle() surely has no problem, told without a root: most arcs of most programs. False where it takes
/// a closer look, as it does where more than half the tolerance is used up, or the arc goes nowhere.
bool surely_fits(const ArcGiven& given, double tolerance);

/// How an arc reads when its center counts from the origin that is in force (G90: the frame's, G91: the arc's start)
/// and when it counts from the other one, as other controls have it (D70). A coordinate of the center that is not
/// written is that of the start in the other reading.
struct CenterReadings {
  /// How far the ends, and R where it is written, are from one circle about the center, mm. Infinite where the words
  /// give no circle, or the center is the start.
  double misfit = 0;
  double other_misfit = 0;
  double radius = 0;  ///< Distance of the center from the start, mm; 0 where the words give no circle.
  double other_radius = 0;
  double chord = 0;             ///< Distance of start and end, mm.
  PlanePoint other_center;      ///< From the start.
  bool is_complete = false;     ///< Both coordinates of the center are written.
  bool has_radius = false;      ///< So is R.
  bool is_same_center = false;  ///< Both readings mean the same point, with what is not written that of the start.

  bool fits(double tolerance) const { return misfit <= tolerance; }
  bool fits_other(double tolerance) const { return other_misfit <= tolerance; }
  /// Meant to fit, and rounded or measured.
  bool nearly_fits_other(double tolerance) const { return other_misfit <= kNearly * tolerance; }
  bool is_legal_in_both_readings(double tolerance) const {
    return !is_same_center && fits(tolerance) && fits_other(tolerance);
  }
  /// Whether the arc shows that centers are meant to count from the other origin. Any center fits a short chord, unless
  /// R says more.
  bool shows_other_origin(double tolerance) const {
    return !fits(tolerance) && fits_other(tolerance) && (has_radius || chord >= kNearly * tolerance);
  }
  /// Whether it shows that they are meant to count from the origin in force.
  bool shows_own_origin(double tolerance) const {
    return is_complete && fits(tolerance) && !nearly_fits_other(tolerance);
  }

  static constexpr double kNearly = 10;  ///< Times the tolerance.
};

/// Reads an arc with at least one coordinate of the center both ways. `start` is in the frame in force; `incremental`
/// says that G91 is in force.
CenterReadings read_center_in_both_modes(const ArcGiven& given, PlanePoint start, bool incremental, double tolerance);

/// Whether an arc that surely fits under G90 surely does not fit with its center counted from the start, nor nearly:
/// told without a root. False where it takes a closer look.
bool surely_absolute(const ArcGiven& given, PlanePoint start, double tolerance);

/// Degrees from start to end about the center, positive counterclockwise, in [-360, 360]; a full turn when both ends
/// are equal (D37). `center` and `end` from the start. Arcs by radius alone never exceed 180 (D36).
double sweep_deg(const PlanePoint& center, const PlanePoint& end, bool counterclockwise);

}  // namespace isocnc::geometry
