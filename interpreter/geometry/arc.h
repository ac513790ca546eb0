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

/// The circle as given in the program. All offsets are from the arc's start, mm.
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

/// A circle through both ends, or the reason why there is none, with the two values that contradict each other.
struct Circle {
  ArcProblem problem = ArcProblem::None;
  PlanePoint center;          ///< Offset from the start, mm.
  double found = 0;           ///< Distance center-start, or the radius as written.
  double wanted = 0;          ///< Distance center-end, distance center-start, or half the chord.
  bool goes_nowhere = false;  ///< The arc has a radius only, and start and end are equal: no sweep (D36).
};

/// Ends that differ by less than this, mm, count as equal (D35).
inline constexpr double kEqualCoordinate = 1e-6;

/// Finds the circle (I.3.4.3.a, D35 to D38); the first problem in the order of D45. `tolerance` in mm.
Circle find_circle(const ArcGiven& given, double tolerance);

/// Fast test without a square root: whether find_circle() surely finds no problem, as for most arcs of most programs.
/// False where only find_circle() can decide, as for a misfit above half the tolerance or an arc that goes nowhere.
bool surely_fits(const ArcGiven& given, double tolerance);

/// The two readings of an arc: with its center counted from the origin in force (G90: the frame's, G91: the arc's
/// start), and from the other origin, as on other controls (D70). In the other reading, a coordinate of the center that
/// is not written is that of the start.
struct CenterReadings {
  /// Deviation of the ends, and of R where it is written, from one circle about the center, mm. Infinite where the
  /// words give no circle, or the center is the start.
  double misfit = 0;
  double other_misfit = 0;
  double radius = 0;  ///< Distance of the center from the start, mm; 0 where the words give no circle.
  double other_radius = 0;
  double chord = 0;             ///< Distance of start and end, mm.
  PlanePoint other_center;      ///< Offset from the start, mm.
  bool is_complete = false;     ///< Whether both coordinates of the center are written.
  bool has_radius = false;      ///< Whether R is written.
  bool is_same_center = false;  ///< Both readings mean the same point, if unwritten coordinates are the start's.

  bool fits(double tolerance) const { return misfit <= tolerance; }
  bool fits_other(double tolerance) const { return other_misfit <= tolerance; }
  /// Whether the other reading was probably meant to fit, with rounded or measured values.
  bool nearly_fits_other(double tolerance) const { return other_misfit <= kNearly * tolerance; }
  bool is_legal_in_both_readings(double tolerance) const {
    return !is_same_center && fits(tolerance) && fits_other(tolerance);
  }
  /// Whether the arc is evidence that centers are meant to count from the other origin. A short chord is none without
  /// an R, because any center fits it.
  bool shows_other_origin(double tolerance) const {
    return !fits(tolerance) && fits_other(tolerance) && (has_radius || chord >= kNearly * tolerance);
  }
  /// Whether the arc is evidence that centers are meant to count from the origin in force.
  bool shows_own_origin(double tolerance) const {
    return is_complete && fits(tolerance) && !nearly_fits_other(tolerance);
  }

  static constexpr double kNearly = 10;  ///< Multiple of the tolerance.
};

/// Computes both readings of an arc with at least one coordinate of the center. `start` is in the frame in force;
/// `incremental` means that G91 is in force.
CenterReadings read_center_in_both_modes(const ArcGiven& given, PlanePoint start, bool incremental, double tolerance);

/// Fast test without a square root, for an arc that surely fits under G90: whether it surely does not even nearly fit
/// with its center counted from the start. False where only a closer look can decide.
bool surely_absolute(const ArcGiven& given, PlanePoint start, double tolerance);

/// Degrees from start to end about the center, positive counterclockwise, in [-360, 360]; a full turn when both ends
/// are equal (D37). `center` and `end` are offsets from the start. Arcs by radius alone never exceed 180 (D36).
double sweep_deg(const PlanePoint& center, const PlanePoint& end, bool counterclockwise);

}  // namespace isocnc::geometry
