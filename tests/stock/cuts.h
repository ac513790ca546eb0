#pragma once

#include <cmath>
#include <numbers>
#include <span>
#include <variant>
#include <vector>

#include "interpreter/solids/tool_shapes.h"
#include "interpreter/stock/stock.h"

/// Blanks, cutters and paths for the tests of removed material.
namespace isocnc::stock::cuts {

using geometry::Vec2;
using geometry::Vec3;
using solids::AxisPlacement;
using solids::RevolvedBody;
using std::numbers::pi;

inline RevolvedBody body(const solids::BodyOrProblem& made) { return std::get<RevolvedBody>(made); }
inline RevolvedBody flat(double radius, double length = 100) { return body(solids::flat_body(radius, length)); }
inline RevolvedBody ball(double radius, double length = 100) { return body(solids::ball_body(radius, length)); }

inline solids::Cuboid box(const Vec3& low, const Vec3& high) { return {low, high}; }
/// 400 x 400 x 100 mm, its upper face at 0, the middle of it at the origin.
inline solids::Cuboid block() { return box({-200, -200, -100}, {200, 200, 0}); }

inline Sweep line(const RevolvedBody& body, const Vec3& from, const Vec3& to, const Vec3& axis = {0, 0, 1},
                  CutTag tag = 1) {
  return {.body = &body, .path = StraightPath{{from, axis}, to}, .tag = tag};
}
inline Sweep arc(const RevolvedBody& body, const Vec3& from, const Vec3& to, const Vec3& center, double degrees,
                 const Vec3& normal = {0, 0, 1}, CutTag tag = 1) {
  return {.body = &body, .path = HelixPath{geometry::helix(from, to, center, normal, degrees)}, .tag = tag};
}
inline Sweep turn(const RevolvedBody& body, const AxisPlacement& from, const AxisPlacement& to, CutTag tag = 1) {
  return {.body = &body, .path = TurningPath{from, to}, .tag = tag};
}
inline Sweep asking(Sweep sweep) {
  sweep.purpose = SweepPurpose::Ask;
  return sweep;
}

inline SweepOutcome apply(Stock& stock, const Sweep& sweep) { return stock.apply(std::span(&sweep, 1)).front(); }

/// What sweeps remove in all, mm^3.
inline double removed(Stock stock, const std::vector<Sweep>& sweeps) {
  const double before = stock.volume();
  stock.apply(sweeps);
  return before - stock.volume();
}

/// A vector tilted from Z towards X.
inline Vec3 tilted(double degrees) { return {std::sin(degrees * pi / 180), 0, std::cos(degrees * pi / 180)}; }

}  // namespace isocnc::stock::cuts
