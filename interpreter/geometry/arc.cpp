#include "interpreter/geometry/arc.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace isocnc::geometry {

double PlanePoint::norm() const { return std::sqrt(u * u + v * v); }

static Circle problem(ArcProblem what, double found = 0, double wanted = 0) {
  return {.problem = what, .found = found, .wanted = wanted};
}

/// The center is equally far from both ends: 2 c.d = d.d, with d from start to end.
static Circle circle_from_center(const ArcGiven& given, double tolerance) {
  const PlanePoint& d = given.end;
  const double dd = d.u * d.u + d.v * d.v;
  PlanePoint center;
  if (given.center_u && given.center_v) {
    center = {*given.center_u, *given.center_v};
  } else if (given.center_u) {
    if (std::abs(d.v) <= kEqualCoordinate) return problem(ArcProblem::CenterUndeterminedByU);
    center = {*given.center_u, (dd - 2 * *given.center_u * d.u) / (2 * d.v)};
  } else {
    if (std::abs(d.u) <= kEqualCoordinate) return problem(ArcProblem::CenterUndeterminedByV);
    center = {(dd - 2 * *given.center_v * d.v) / (2 * d.u), *given.center_v};
  }
  const double from_start = center.norm();
  const double from_end = (center - d).norm();
  if (std::abs(from_start - from_end) > tolerance || from_start <= kEqualCoordinate)
    return problem(ArcProblem::CenterMismatch, from_start, from_end);
  if (given.radius && !(std::abs(*given.radius - from_start) <= tolerance))
    return problem(ArcProblem::RadiusMismatch, *given.radius, from_start);
  return {.center = center, .found = from_start, .wanted = from_end};
}

/// Of the two circles through both ends, the one whose arc is at most half a turn (D36).
static Circle circle_from_radius(const ArcGiven& given, double tolerance) {
  const PlanePoint& d = given.end;
  const double chord = d.norm();
  const double radius = *given.radius;
  if (!(radius > 0) || chord - 2 * radius > tolerance) return problem(ArcProblem::RadiusTooSmall, radius, chord / 2);
  if (chord <= kEqualCoordinate) return {.found = radius, .wanted = radius, .goes_nowhere = true};
  const double height = std::sqrt(std::max(0.0, radius * radius - chord * chord / 4)) / chord;
  const double side = given.counterclockwise ? height : -height;  // To the left of the chord for G03.
  return {.center = {d.u / 2 - d.v * side, d.v / 2 + d.u * side}, .found = radius, .wanted = radius};
}

Circle find_circle(const ArcGiven& given, double tolerance) {
  return given.center_u || given.center_v ? circle_from_center(given, tolerance) : circle_from_radius(given, tolerance);
}

bool surely_fits(const ArcGiven& given, double tolerance) {
  const PlanePoint& d = given.end;
  if (given.center_u && given.center_v && !given.radius) {
    const PlanePoint center{*given.center_u, *given.center_v};
    const PlanePoint from_end = center - d;
    const double start2 = center.u * center.u + center.v * center.v;
    const double end2 = from_end.u * from_end.u + from_end.v * from_end.v;
    // |a - b| is |a2 - b2| / (a + b), and a + b is more than a: half the tolerance, well clear of any rounding.
    return (start2 - end2) * (start2 - end2) <= tolerance * tolerance * start2 &&
           start2 > 4 * kEqualCoordinate * kEqualCoordinate;
  }
  if (given.center_u || given.center_v || !given.radius) return false;
  // Half of what a half circle may lack, well clear of any rounding.
  const double longest = 2 * *given.radius + tolerance / 2;
  const double chord2 = d.u * d.u + d.v * d.v;
  return *given.radius > 0 && chord2 <= longest * longest * (1 - 1e-12) &&
         chord2 > 4 * kEqualCoordinate * kEqualCoordinate;
}

/// Deviation of the ends of an arc, and of its R, from one circle about the center, mm.
static double misfit_about(PlanePoint center, const ArcGiven& given) {
  const double radius = center.norm();
  if (radius <= kEqualCoordinate) return std::numeric_limits<double>::infinity();
  const double misfit = std::abs(radius - (center - given.end).norm());
  return given.radius ? std::max(misfit, std::abs(*given.radius - radius)) : misfit;
}

CenterReadings read_center_in_both_modes(const ArcGiven& given, PlanePoint start, bool incremental, double tolerance) {
  CenterReadings readings{.chord = given.end.norm(),
                          .is_complete = given.center_u && given.center_v,
                          .has_radius = given.radius.has_value()};
  PlanePoint center{given.center_u.value_or(0), given.center_v.value_or(0)};
  if (readings.is_complete) {
    readings.misfit = misfit_about(center, given);
    readings.radius = center.norm();
  } else {
    const Circle circle = find_circle(given, tolerance);
    const bool is_circle = circle.problem == ArcProblem::None;
    readings.misfit = is_circle ? 0 : std::numeric_limits<double>::infinity();
    readings.radius = circle.center.norm();
    if (is_circle) center = circle.center;
  }
  const auto other = [&](const std::optional<double>& coordinate, double from) {
    return coordinate ? *coordinate + (incremental ? -from : from) : 0;
  };
  readings.other_center = {other(given.center_u, start.u), other(given.center_v, start.v)};
  readings.other_misfit = misfit_about(readings.other_center, given);
  readings.other_radius = readings.other_center.norm();
  readings.is_same_center = (readings.other_center - center).norm() <= kEqualCoordinate;
  return readings;
}

bool surely_absolute(const ArcGiven& given, PlanePoint start, double tolerance) {
  if (!given.center_u || !given.center_v) return false;
  const PlanePoint center{*given.center_u + start.u, *given.center_v + start.v};
  const PlanePoint from_end = center - given.end;
  const double start2 = center.u * center.u + center.v * center.v;
  const double end2 = from_end.u * from_end.u + from_end.v * from_end.v;
  // |a - b| is |a2 - b2| / (a + b), and (a + b)2 is at most 2 (a2 + b2).
  const double nearly = CenterReadings::kNearly * tolerance;
  return (start2 - end2) * (start2 - end2) > 2 * nearly * nearly * (start2 + end2);
}

double sweep_deg(const PlanePoint& center, const PlanePoint& end, bool counterclockwise) {
  if (std::abs(end.u) <= kEqualCoordinate && std::abs(end.v) <= kEqualCoordinate) return counterclockwise ? 360 : -360;
  const PlanePoint a{-center.u, -center.v};
  const PlanePoint b = end - center;
  const double angle = std::atan2(a.u * b.v - a.v * b.u, a.u * b.u + a.v * b.v) * 180 / std::numbers::pi;
  if (counterclockwise) return angle > 0 ? angle : angle + 360;
  return angle < 0 ? angle : angle - 360;
}

}  // namespace isocnc::geometry
